//! The process's limit of open files: each connection takes one.

use rustix::process::{Resource, getrlimit, setrlimit};

/// Files that are not connections: the log, the listener, the store of jobs, the callbacks. They are reserved, since
/// idle clients could otherwise shut out the store.
const OTHER_FILES: u64 = 128;

/// Raise the soft limit as far as permitted, and return how many of the wanted connections it allows. Many systems set
/// it to 1024 for old programs.
pub(super) fn room_for(connections: usize) -> usize {
    let mut limit = getrlimit(Resource::Nofile);
    limit.current = limit.maximum;
    if let Err(error) = setrlimit(Resource::Nofile, limit) {
        tracing::warn!(%error, "the limit of open files could not be raised");
    }
    let open_files = getrlimit(Resource::Nofile).current;
    let room = open_files.map_or(usize::MAX, room_within);
    if room < connections {
        tracing::warn!(
            ?open_files,
            connections = room,
            "the limit of open files allows fewer connections than max_connections"
        );
    }
    connections.min(room)
}

fn room_within(open_files: u64) -> usize {
    usize::try_from(open_files.saturating_sub(OTHER_FILES).max(1)).unwrap_or(usize::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn connections_leave_files_for_the_rest() {
        assert_eq!((room_within(1024), room_within(10)), (896, 1));
        assert_eq!(room_for(1), 1);
    }

    #[test]
    fn the_soft_limit_is_raised_to_the_hard_one() {
        room_for(1);
        let limit = getrlimit(Resource::Nofile);
        assert_eq!(limit.current, limit.maximum);
    }
}
