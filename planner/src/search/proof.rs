//! As few landmarks as prove the bound.

use super::pace::Pace;
use super::problem::Node;
use crate::budget::Interrupted;

/// Landmarks that prove the same bound: disjoint ones where those suffice, which anybody can check by counting; otherwise
/// all that hold no other. Smallest first. Where the budget ends, they come as they are.
pub(super) fn concise(mut landmarks: Vec<Vec<Node>>, bound: usize, pace: &mut Pace<'_>) -> Vec<Vec<Node>> {
    landmarks.sort_unstable_by(|a, b| a.len().cmp(&b.len()).then_with(|| a.cmp(b)));
    let Ok(chosen) = disjoint(&landmarks, pace) else { return landmarks };
    if chosen.len() >= bound {
        return chosen.into_iter().take(bound).map(|at| core::mem::take(&mut landmarks[at])).collect();
    }
    let Ok(chosen) = minimal(&landmarks, pace) else { return landmarks };
    chosen.into_iter().map(|at| core::mem::take(&mut landmarks[at])).collect()
}

/// Landmarks without a common member.
fn disjoint(landmarks: &[Vec<Node>], pace: &mut Pace<'_>) -> Result<Vec<usize>, Interrupted> {
    let mut used = vec![false; width(landmarks)];
    let mut chosen = Vec::new();
    for (at, landmark) in landmarks.iter().enumerate() {
        pace.step(1 + landmark.len() / 64)?;
        if !landmark.iter().any(|&node| used[node as usize]) {
            landmark.iter().for_each(|&node| used[node as usize] = true);
            chosen.push(at);
        }
    }
    Ok(chosen)
}

/// Landmarks that hold no other one.
fn minimal(landmarks: &[Vec<Node>], pace: &mut Pace<'_>) -> Result<Vec<usize>, Interrupted> {
    let mut member = vec![false; width(landmarks)];
    // Those kept, by their first member: whoever holds one has that.
    let mut kept_by: Vec<Vec<usize>> = vec![Vec::new(); member.len()];
    let mut kept = Vec::new();
    for (at, landmark) in landmarks.iter().enumerate() {
        pace.step(1 + landmark.len() / 64)?;
        let rivals = landmark.iter().flat_map(|&node| &kept_by[node as usize]);
        landmark.iter().for_each(|&node| member[node as usize] = true);
        let mut holds = false;
        for &rival in rivals {
            pace.step(1 + landmarks[rival].len() / 64)?;
            holds = holds || landmarks[rival].iter().all(|&node| member[node as usize]);
        }
        landmark.iter().for_each(|&node| member[node as usize] = false);
        if !holds {
            kept_by[landmark[0] as usize].push(at);
            kept.push(at);
        }
    }
    Ok(kept)
}

fn width(landmarks: &[Vec<Node>]) -> usize {
    landmarks.iter().flatten().max().map_or(0, |&node| node as usize + 1)
}
