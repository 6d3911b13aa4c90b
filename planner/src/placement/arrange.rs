//! Rounds of search for an arrangement: iterative broadening (Ginsberg & Harvey 1992), from the first order and the best places
//! only to more of both; then once more for more room.

use super::arranger::Arranger;
use super::drop_offs::DropOffs;
use super::effort::{Effort, EffortMeter};
use super::task::{Arrangement, Task};
use super::{GAPS, ROOMIER_GAPS};
use crate::budget::{Budget, Interrupted, Stop, Ticker};

/// The width of the last round. Past that, other sets and extra moves promise more than further places of the same
/// kind.
const MAX_WIDTH: usize = 16;

/// An arrangement of the task. `None` if none was found among the candidates within the effort.
///
/// # Errors
/// [`Interrupted`] when the budget ends.
pub fn arrange(task: &Task<'_>, effort: &mut Effort, budget: &Budget<'_>) -> Result<Option<Arrangement>, Interrupted> {
    let Some(found) = arrange_with(task, &GAPS, effort, budget)? else { return Ok(None) };
    if found.least_gap() >= task.scene.gripper().margin() + GAPS[0] {
        return Ok(Some(found));
    }
    // By a copy of the effort, and whatever the budget says: more room must not cost a plan.
    let roomier = arrange_with(task, &ROOMIER_GAPS, &mut { *effort }, budget).ok().flatten();
    let better = |other: &Arrangement| other.least_gap() > found.least_gap() && other.drops() <= found.drops();
    Ok(Some(roomier.filter(better).unwrap_or(found)))
}

fn arrange_with(
    task: &Task<'_>,
    gaps: &[f64],
    effort: &mut Effort,
    budget: &Budget<'_>,
) -> Result<Option<Arrangement>, Interrupted> {
    let mut drop_offs = DropOffs::new(task.scene);
    let mut ticker = Ticker::new(budget);
    for &object in task.set.iter().filter(|object| task.leaves(**object)) {
        if !drop_offs.take(object, |looks| ticker.step(looks))? {
            return Ok(None);
        }
    }
    let mut width = 1;
    loop {
        let mut arranger = Arranger::new(task, gaps, width, drop_offs.clone(), EffortMeter::new(effort, budget));
        match arranger.step(task.set, task.extra) {
            Ok(Some(arrangement)) => return Ok(Some(arrangement)),
            Ok(None) if arranger.truncated() && width < MAX_WIDTH => width *= 2,
            Ok(None) | Err(Stop::Spent) => return Ok(None),
            Err(Stop::Interrupted) => return Err(Interrupted),
        }
    }
}
