//! A small set of landmarks that proves the bound.

use super::problem::Node;
use crate::budget::{Interrupted, Ticker};

/// Landmarks that prove the same bound, smallest first: disjoint ones where these suffice, since they are checked by
/// counting; otherwise all that are not supersets of another. Where the budget ends, all of them.
pub(super) fn concise(mut landmarks: Vec<Vec<Node>>, bound: usize, ticker: &mut Ticker<'_>) -> Vec<Vec<Node>> {
    landmarks.sort_unstable_by(|a, b| a.len().cmp(&b.len()).then_with(|| a.cmp(b)));
    let Ok(chosen) = disjoint(&landmarks, ticker) else { return landmarks };
    if chosen.len() >= bound {
        return chosen.into_iter().take(bound).map(|at| core::mem::take(&mut landmarks[at])).collect();
    }
    let Ok(chosen) = minimal(&landmarks, ticker) else { return landmarks };
    chosen.into_iter().map(|at| core::mem::take(&mut landmarks[at])).collect()
}

/// Positions of greedily chosen disjoint landmarks.
fn disjoint(landmarks: &[Vec<Node>], ticker: &mut Ticker<'_>) -> Result<Vec<usize>, Interrupted> {
    let mut used = vec![false; width(landmarks)];
    let mut chosen = Vec::new();
    for (at, landmark) in landmarks.iter().enumerate() {
        ticker.step(1 + landmark.len() / 64)?;
        if !landmark.iter().any(|&node| used[node as usize]) {
            landmark.iter().for_each(|&node| used[node as usize] = true);
            chosen.push(at);
        }
    }
    Ok(chosen)
}

/// Positions of the landmarks that are no supersets of another.
fn minimal(landmarks: &[Vec<Node>], ticker: &mut Ticker<'_>) -> Result<Vec<usize>, Interrupted> {
    let mut member = vec![false; width(landmarks)];
    // Kept landmarks by their first member, which every superset has.
    let mut kept_by: Vec<Vec<usize>> = vec![Vec::new(); member.len()];
    let mut kept = Vec::new();
    for (at, landmark) in landmarks.iter().enumerate() {
        ticker.step(1 + landmark.len() / 64)?;
        let rivals = landmark.iter().flat_map(|&node| &kept_by[node as usize]);
        landmark.iter().for_each(|&node| member[node as usize] = true);
        let mut holds = false;
        for &rival in rivals {
            ticker.step(1 + landmarks[rival].len() / 64)?;
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
