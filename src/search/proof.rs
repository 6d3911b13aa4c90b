//! As few landmarks as prove the bound.

use crate::scene::ObjectIndex;

/// Landmarks that prove the same bound: disjoint ones where those suffice, which anybody can check by counting; otherwise
/// all that hold no other. `landmarks` are sorted by size.
pub(super) fn concise(landmarks: Vec<Vec<ObjectIndex>>, bound: usize) -> Vec<Vec<ObjectIndex>> {
    let mut used: Vec<ObjectIndex> = Vec::new();
    let mut disjoint: Vec<Vec<ObjectIndex>> = Vec::new();
    for landmark in &landmarks {
        if disjoint.len() < bound && !landmark.iter().any(|object| used.contains(object)) {
            used.extend(landmark);
            disjoint.push(landmark.clone());
        }
    }
    if disjoint.len() >= bound {
        return disjoint;
    }
    let mut kept: Vec<Vec<ObjectIndex>> = Vec::with_capacity(landmarks.len());
    for landmark in landmarks {
        if !kept.iter().any(|smaller| smaller.iter().all(|object| landmark.contains(object))) {
            kept.push(landmark);
        }
    }
    kept
}
