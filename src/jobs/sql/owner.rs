//! What owners ask of their jobs, apart from looking at them.

use sqlx::Error;

use super::change::{Change, Ending, Standing};
use super::herald::News;
use super::row;
use crate::jobs::{Cancellation, JobId, JobState, Owner, Removal, Timestamp};

/// How the owner's job stands; another's is none.
async fn own(change: &mut Change<'_>, owner: &Owner, id: JobId) -> Result<Option<Standing>, Error> {
    Ok(change.standing(id).await?.filter(|job| job.owner == *owner))
}

pub(super) async fn cancel(
    change: &mut Change<'_>,
    owner: &Owner,
    id: JobId,
    now: Timestamp,
) -> Result<Cancellation, Error> {
    let Some(job) = own(change, owner, id).await? else { return Ok(Cancellation::Unknown) };
    match job.state {
        JobState::Queued => change.end(&job, &Ending::bare(JobState::Cancelled), now).await?,
        JobState::Running => {
            let query = sqlx::query("UPDATE jobs SET cancel_requested = 1 WHERE id = $1").bind(id.to_string());
            query.execute(change.connection()).await?;
            change.announce(News { recall: true, ..News::of(id) });
        }
        _ => return Ok(Cancellation::Finished),
    }
    let job = row::find(change.connection(), Some(owner), id).await?.ok_or(Error::RowNotFound)?;
    Ok(Cancellation::Accepted(Box::new(job)))
}

pub(super) async fn forget(change: &mut Change<'_>, owner: &Owner, id: JobId) -> Result<Removal, Error> {
    let Some(job) = own(change, owner, id).await? else { return Ok(Removal::Unknown) };
    if !job.state.finished() {
        return Ok(Removal::Unfinished);
    }
    sqlx::query("DELETE FROM jobs WHERE id = $1").bind(id.to_string()).execute(change.connection()).await?;
    change.announce(News::of(id));
    Ok(Removal::Forgotten)
}
