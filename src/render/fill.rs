//! What the steps bring to each drop-off.

use std::collections::HashMap;

use singulate_planner::scene::Scene;
use singulate_planner::statement::{PickDrop, Statement, Step};

/// A drop-off with what the steps bring there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Fill<'a> {
    /// The id of the drop-off.
    pub id: &'a str,
    /// How many objects it holds in the end.
    pub held: usize,
    /// How many it takes; `None` if any number.
    pub capacity: Option<u64>,
}

/// Every drop-off of the scene, in order, after all steps.
pub fn fills<'a>(scene: &'a Scene, stated: &Statement) -> Vec<Fill<'a>> {
    let mut held: HashMap<&str, usize> = HashMap::new();
    drops(stated).for_each(|drop| *held.entry(&drop.drop_off).or_default() += 1);
    let fill = |(id, capacity)| Fill { id, held: held.get(id).copied().unwrap_or_default(), capacity };
    scene.drop_offs().iter().map(|drop_off| fill((drop_off.id(), drop_off.capacity()))).collect()
}

/// The steps that take an object off the table.
pub(super) fn drops(stated: &Statement) -> impl Iterator<Item = &PickDrop> {
    stated.steps().iter().filter_map(pick_drop)
}

/// The id of the drop-off to which the step takes its object; `None` if it stays on the table.
pub(super) fn drop_off(step: &Step) -> Option<&str> {
    pick_drop(step).map(|step| step.drop_off.as_str())
}

fn pick_drop(step: &Step) -> Option<&PickDrop> {
    match step {
        Step::PickDrop(step) => Some(step),
        _ => None,
    }
}

impl Fill<'_> {
    /// The number of objects, as it is written beside the id: `2 of 4` with a capacity, else `3 objects` or `empty`.
    pub fn amount(&self) -> String {
        match (self.capacity, self.held) {
            (Some(capacity), held) => format!("{held} of {capacity}"),
            (None, 0) => "empty".to_owned(),
            (None, 1) => "1 object".to_owned(),
            (None, held) => format!("{held} objects"),
        }
    }

    /// True if it takes no more.
    pub(super) fn full(&self) -> bool {
        self.capacity.is_some_and(|capacity| self.held as u64 >= capacity)
    }
}
