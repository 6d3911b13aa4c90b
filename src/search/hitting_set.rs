//! A least set that meets every landmark.
//!
//! The instance is first cut down (single members are forced; a landmark that holds another says nothing; a member met by
//! no more landmarks than another is not needed), then split into components, and each is solved by depth-first search
//! under a rising limit, pruned by disjoint landmarks.

use super::problem::Node;
use crate::budget::{Budget, Interrupted};

/// A least hitting set. Where the budget ends first: `Err` with the bound reached.
pub(super) fn least(landmarks: &[Vec<Node>], budget: &Budget<'_>) -> Result<Vec<Node>, usize> {
    let mut kernel = Kernel::reduce(landmarks);
    let mut bound = kernel.forced.len();
    let mut interrupted = false;
    for part in kernel.components() {
        match Component::new(&part).solve(budget, interrupted) {
            Ok(members) => {
                bound += members.len();
                kernel.forced.extend(members);
            }
            Err(reached) => {
                bound += reached;
                interrupted = true;
            }
        }
    }
    kernel.forced.sort_unstable();
    if interrupted { Err(bound) } else { Ok(kernel.forced) }
}

/// A small, not always least, hitting set: again and again the member that meets most of what is left.
pub(super) fn greedy(landmarks: &[Vec<Node>]) -> Vec<Node> {
    let nodes = landmarks.iter().flatten().max().map_or(0, |&node| node as usize + 1);
    let mut count = vec![0_u32; nodes];
    landmarks.iter().flatten().for_each(|&node| count[node as usize] += 1);
    let mut open: Vec<&Vec<Node>> = landmarks.iter().collect();
    let mut members = Vec::new();
    while !open.is_empty() {
        let Some(best) = (0..count.len()).max_by_key(|&node| (count[node], node)) else { break };
        #[expect(clippy::cast_possible_truncation, reason = "counts nodes")]
        let best = best as Node;
        members.push(best);
        open.retain(|landmark| {
            let met = landmark.contains(&best);
            if met {
                landmark.iter().for_each(|&node| count[node as usize] -= 1);
            }
            !met
        });
    }
    members.sort_unstable();
    members
}

/// What is left of an instance once nothing obvious can be said any more.
struct Kernel {
    forced: Vec<Node>,
    /// Sorted members each.
    open: Vec<Vec<Node>>,
}

impl Kernel {
    fn reduce(landmarks: &[Vec<Node>]) -> Self {
        let mut kernel = Self { forced: Vec::new(), open: landmarks.to_vec() };
        loop {
            let before = (kernel.open.len(), kernel.open.iter().map(Vec::len).sum::<usize>());
            kernel.force_singles();
            kernel.drop_supersets();
            kernel.drop_dominated_members();
            if before == (kernel.open.len(), kernel.open.iter().map(Vec::len).sum()) {
                return kernel;
            }
        }
    }

    fn force_singles(&mut self) {
        let mut singles: Vec<Node> =
            self.open.iter().filter(|landmark| landmark.len() == 1).map(|landmark| landmark[0]).collect();
        singles.sort_unstable();
        singles.dedup();
        self.open.retain(|landmark| !landmark.iter().any(|node| singles.binary_search(node).is_ok()));
        self.forced.extend(singles);
    }

    fn drop_supersets(&mut self) {
        self.open.sort_unstable_by(|a, b| a.len().cmp(&b.len()).then_with(|| a.cmp(b)));
        let mut kept: Vec<Vec<Node>> = Vec::with_capacity(self.open.len());
        for landmark in self.open.drain(..) {
            if !kept.iter().any(|smaller| is_subset(smaller, &landmark)) {
                kept.push(landmark);
            }
        }
        self.open = kept;
    }

    /// A member that meets a part of the landmarks that another member meets is never needed.
    fn drop_dominated_members(&mut self) {
        let nodes = self.open.iter().flatten().max().map_or(0, |&node| node as usize + 1);
        let mut met_by: Vec<Vec<u32>> = vec![Vec::new(); nodes];
        for (landmark, at) in self.open.iter().zip(0..) {
            landmark.iter().for_each(|&node| met_by[node as usize].push(at));
        }
        let mut dominated = vec![false; nodes];
        for node in (0..nodes).filter(|&node| !met_by[node].is_empty()) {
            // Whoever dominates it is in each of its landmarks, so in its first.
            dominated[node] = self.open[met_by[node][0] as usize].iter().any(|&other| {
                let other = other as usize;
                let (mine, theirs) = (&met_by[node], &met_by[other]);
                other != node
                    && !dominated[other]
                    && mine.len() <= theirs.len()
                    && (mine.len() < theirs.len() || other > node)
                    && is_subset(mine, theirs)
            });
        }
        for landmark in &mut self.open {
            landmark.retain(|&node| !dominated[node as usize]);
        }
    }

    /// The open landmarks in groups that share no member.
    fn components(&self) -> Vec<Vec<Vec<Node>>> {
        let nodes = self.open.iter().flatten().max().map_or(0, |&node| node as usize + 1);
        let mut group_of_node: Vec<Option<usize>> = vec![None; nodes];
        let mut groups: Vec<Vec<usize>> = Vec::new();
        for (at, landmark) in self.open.iter().enumerate() {
            let mut joined: Vec<usize> = landmark.iter().filter_map(|&node| group_of_node[node as usize]).collect();
            joined.sort_unstable();
            joined.dedup();
            let mut merged = vec![at];
            for group in joined {
                merged.append(&mut groups[group]);
            }
            let members = merged.iter().flat_map(|&at| &self.open[at]);
            members.for_each(|&node| group_of_node[node as usize] = Some(groups.len()));
            groups.push(merged);
        }
        let group = |mut at: Vec<usize>| {
            at.sort_unstable();
            at.into_iter().map(|at| self.open[at].clone()).collect()
        };
        groups.into_iter().filter(|group| !group.is_empty()).map(group).collect()
    }
}

/// Both sorted.
fn is_subset(small: &[u32], large: &[u32]) -> bool {
    let mut rest = large.iter();
    small.iter().all(|wanted| rest.by_ref().find(|member| *member >= wanted) == Some(wanted))
}

/// One component, with its members numbered densely.
struct Component {
    nodes: Vec<Node>,
    landmarks: Vec<Vec<u32>>,
    /// Per member the landmarks that it meets.
    met_by: Vec<Vec<u32>>,
}

/// Where the depth-first search stands.
struct State {
    /// Per landmark how many chosen members meet it.
    met: Vec<u32>,
    /// Per member whether it is ruled out in this branch.
    excluded: Vec<bool>,
    chosen: Vec<u32>,
}

impl Component {
    fn new(landmarks: &[Vec<Node>]) -> Self {
        let mut nodes: Vec<Node> = landmarks.iter().flatten().copied().collect();
        nodes.sort_unstable();
        nodes.dedup();
        let mut met_by = vec![Vec::new(); nodes.len()];
        let number = |node: &Node| u32::try_from(nodes.partition_point(|other| other < node)).unwrap_or(u32::MAX);
        let landmarks: Vec<Vec<u32>> = landmarks.iter().map(|landmark| landmark.iter().map(number).collect()).collect();
        for (landmark, at) in landmarks.iter().zip(0..) {
            landmark.iter().for_each(|&member| met_by[member as usize].push(at));
        }
        Self { nodes, landmarks, met_by }
    }

    /// `Err` with the bound reached if the budget ends first, or if `skip`.
    fn solve(&self, budget: &Budget<'_>, skip: bool) -> Result<Vec<Node>, usize> {
        let mut state =
            State { met: vec![0; self.landmarks.len()], excluded: vec![false; self.nodes.len()], chosen: Vec::new() };
        let mut limit = self.disjoint(&state).0;
        loop {
            if skip {
                return Err(limit);
            }
            match self.descend(&mut state, limit, budget) {
                Ok(true) => return Ok(state.chosen.iter().map(|&member| self.nodes[member as usize]).collect()),
                Ok(false) => limit += 1,
                Err(Interrupted) => return Err(limit),
            }
        }
    }

    /// True if at most `limit` more members meet what is left; they are then in `state.chosen`.
    fn descend(&self, state: &mut State, limit: usize, budget: &Budget<'_>) -> Result<bool, Interrupted> {
        budget.check()?;
        let (bound, smallest) = self.disjoint(state);
        let Some(smallest) = smallest else { return Ok(true) };
        if bound > limit {
            return Ok(false);
        }
        let mut branches: Vec<u32> =
            self.landmarks[smallest].iter().copied().filter(|&member| !state.excluded[member as usize]).collect();
        let gain = |member: u32| self.met_by[member as usize].iter().filter(|&&at| state.met[at as usize] == 0).count();
        branches.sort_by_cached_key(|&member| core::cmp::Reverse(gain(member)));
        let mut found = false;
        for &member in &branches {
            self.choose(state, member, true);
            found = self.descend(state, limit - 1, budget)?;
            if found {
                break;
            }
            self.choose(state, member, false);
            state.excluded[member as usize] = true;
        }
        branches.iter().for_each(|&member| state.excluded[member as usize] = false);
        Ok(found)
    }

    fn choose(&self, state: &mut State, member: u32, on: bool) {
        for &at in &self.met_by[member as usize] {
            if on {
                state.met[at as usize] += 1;
            } else {
                state.met[at as usize] -= 1;
            }
        }
        if on {
            state.chosen.push(member);
        } else {
            state.chosen.pop();
        }
    }

    /// How many landmarks that are still open can be picked without a common member, smallest first, and the smallest.
    /// A landmark whose members are all ruled out makes the bound infinite.
    fn disjoint(&self, state: &State) -> (usize, Option<usize>) {
        let size = |at: usize| self.landmarks[at].iter().filter(|&&member| !state.excluded[member as usize]).count();
        let mut open: Vec<(usize, usize)> =
            (0..self.landmarks.len()).filter(|&at| state.met[at] == 0).map(|at| (size(at), at)).collect();
        open.sort_unstable();
        if open.first().is_some_and(|&(size, _)| size == 0) {
            return (usize::MAX, Some(open[0].1));
        }
        let mut used = state.excluded.clone();
        let mut bound = 0;
        for &(_, at) in &open {
            let free = |&member: &u32| state.excluded[member as usize] || !used[member as usize];
            if self.landmarks[at].iter().all(free) {
                self.landmarks[at].iter().for_each(|&member| used[member as usize] = true);
                bound += 1;
            }
        }
        (bound, open.first().map(|&(_, at)| at))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn brute_force(landmarks: &[Vec<Node>], nodes: u32) -> usize {
        (0_u32..1 << nodes)
            .filter(|set| landmarks.iter().all(|landmark| landmark.iter().any(|node| set >> node & 1 == 1)))
            .map(|set| set.count_ones() as usize)
            .min()
            .unwrap_or(usize::MAX)
    }

    proptest! {
        #[test]
        fn no_set_smaller_than_the_least_one_meets_all(
            sets in proptest::collection::vec(proptest::collection::btree_set(0_u32..12, 1..5), 0..16),
        ) {
            let sets: Vec<Vec<Node>> = sets.into_iter().map(|set| set.into_iter().collect()).collect();
            let found = least(&sets, &Budget::unlimited()).expect("unlimited");
            let meets = |members: &[Node]| sets.iter().all(|set| set.iter().any(|node| members.contains(node)));
            prop_assert!(meets(&found) && meets(&greedy(&sets)));
            prop_assert_eq!(found.len(), brute_force(&sets, 12));
        }
    }
}
