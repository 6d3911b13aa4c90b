//! Incremental forward chaining (Dowling & Gallier 1984) under a growing set of allowed nodes, with undo.

use super::problem::{HornRules, Node};

/// What follows when only the allowed nodes may be moved. A node is moved once it is both allowed and graspable.
#[derive(Debug, Clone)]
pub(super) struct ForwardChaining<'p> {
    problem: &'p HornRules,
    /// Per rule the number of members of its body that are not moved.
    standing: Vec<u32>,
    allowed: Vec<bool>,
    graspable: Vec<bool>,
    trail: Vec<Change>,
    /// Position in the trail up to which changes are propagated.
    propagated: usize,
    /// Rules read, and other work of the same cost, that the ticker has not counted yet.
    work: usize,
}

#[derive(Debug, Clone, Copy)]
enum Change {
    Allowed(Node),
    Graspable(Node),
    Moved(Node),
}

/// Rules read per step of the ticker.
const RULES_A_STEP: usize = 100;

/// A point of the trail to which the chaining can be undone.
#[derive(Debug, Clone, Copy)]
pub(super) struct Mark(usize);

impl<'p> ForwardChaining<'p> {
    /// No node is allowed.
    pub(super) fn new(problem: &'p HornRules) -> Self {
        let nodes = problem.movable() + 1;
        let mut chain = Self {
            problem,
            standing: Vec::with_capacity(problem.rules()),
            allowed: vec![false; nodes],
            graspable: vec![false; nodes],
            trail: Vec::new(),
            propagated: 0,
            work: nodes + problem.rules(),
        };
        for rule in 0..u32::try_from(problem.rules()).unwrap_or(u32::MAX) {
            let body = problem.body(rule).len();
            chain.standing.push(u32::try_from(body).unwrap_or(u32::MAX));
            if body == 0 {
                chain.grasp(problem.head(rule));
            }
        }
        chain
    }

    /// Allows a node and propagates.
    pub(super) fn allow(&mut self, node: Node) {
        if core::mem::replace(&mut self.allowed[node as usize], true) {
            return;
        }
        self.work += 1;
        self.trail.push(Change::Allowed(node));
        if self.graspable[node as usize] {
            self.trail.push(Change::Moved(node));
        }
        while let Some(&change) = self.trail.get(self.propagated) {
            self.propagated += 1;
            if let Change::Moved(node) = change {
                self.unblock(node);
            }
        }
    }

    fn unblock(&mut self, node: Node) {
        self.work += self.problem.condition_of(node).len();
        for &rule in self.problem.condition_of(node) {
            self.standing[rule as usize] -= 1;
            if self.standing[rule as usize] == 0 {
                self.grasp(self.problem.head(rule));
            }
        }
    }

    fn grasp(&mut self, node: Node) {
        if core::mem::replace(&mut self.graspable[node as usize], true) {
            return;
        }
        self.trail.push(Change::Graspable(node));
        if self.allowed[node as usize] {
            self.trail.push(Change::Moved(node));
        }
    }

    /// Steps of a [`Ticker`](crate::budget::Ticker) for the work since the last call.
    pub(super) fn steps(&mut self) -> usize {
        let steps = self.work / RULES_A_STEP;
        self.work %= RULES_A_STEP;
        steps
    }

    pub(super) fn mark(&self) -> Mark {
        Mark(self.trail.len())
    }

    /// Undoes everything since the mark.
    pub(super) fn undo(&mut self, mark: Mark) {
        for change in self.trail.drain(mark.0..).rev() {
            match change {
                Change::Allowed(node) => self.allowed[node as usize] = false,
                Change::Graspable(node) => self.graspable[node as usize] = false,
                Change::Moved(node) => {
                    self.work += self.problem.condition_of(node).len();
                    self.problem.condition_of(node).iter().for_each(|&rule| self.standing[rule as usize] += 1);
                }
            }
        }
        self.propagated = self.trail.len();
    }

    /// True if the target can be grasped.
    pub(super) fn reaches_target(&self) -> bool {
        self.graspable[self.problem.target() as usize]
    }

    pub(super) fn is_allowed(&self, node: Node) -> bool {
        self.allowed[node as usize]
    }

    pub(super) fn is_graspable(&self, node: Node) -> bool {
        self.graspable[node as usize]
    }

    /// True for a graspable node that is not allowed. Only such nodes, once allowed, change anything.
    pub(super) fn is_frontier(&self, node: Node) -> bool {
        self.graspable[node as usize] && !self.allowed[node as usize]
    }

    /// The moved nodes, in order.
    pub(super) fn moved(&self) -> impl Iterator<Item = Node> + '_ {
        self.trail.iter().filter_map(|change| match change {
            Change::Moved(node) => Some(*node),
            _ => None,
        })
    }

    /// The nodes that became graspable since the mark.
    pub(super) fn graspable_since(&self, mark: Mark) -> impl Iterator<Item = Node> + '_ {
        self.trail[mark.0..].iter().filter_map(|change| match change {
            Change::Graspable(node) => Some(*node),
            _ => None,
        })
    }
}
