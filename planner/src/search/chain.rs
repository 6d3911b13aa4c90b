//! Forward chaining under a growing set of movable nodes, with undo.

use super::problem::{Node, Problem};

/// What follows when only some nodes may be moved. Moving a node needs both: it may be moved, and it is graspable.
#[derive(Debug, Clone)]
pub(super) struct Chain<'p> {
    problem: &'p Problem,
    /// Per rule how many members of its body still stand.
    standing: Vec<u32>,
    allowed: Vec<bool>,
    graspable: Vec<bool>,
    trail: Vec<Event>,
    /// Position in the trail up to which consequences are drawn.
    drawn: usize,
    /// Rules looked at, and what else costs as much, since somebody paid for it.
    work: usize,
}

#[derive(Debug, Clone, Copy)]
enum Event {
    Allowed(Node),
    Graspable(Node),
    Moved(Node),
}

/// How many rules are looked at in the time of one step.
const RULES_A_STEP: usize = 100;

/// A point to which a chain can go back.
#[derive(Debug, Clone, Copy)]
pub(super) struct Mark(usize);

impl<'p> Chain<'p> {
    /// Nothing may be moved.
    pub(super) fn new(problem: &'p Problem) -> Self {
        let nodes = problem.movable() + 1;
        let mut chain = Self {
            problem,
            standing: Vec::with_capacity(problem.rules()),
            allowed: vec![false; nodes],
            graspable: vec![false; nodes],
            trail: Vec::new(),
            drawn: 0,
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

    /// Let a node be moved, and draw the consequences.
    pub(super) fn allow(&mut self, node: Node) {
        if core::mem::replace(&mut self.allowed[node as usize], true) {
            return;
        }
        self.work += 1;
        self.trail.push(Event::Allowed(node));
        if self.graspable[node as usize] {
            self.trail.push(Event::Moved(node));
        }
        while let Some(&event) = self.trail.get(self.drawn) {
            self.drawn += 1;
            if let Event::Moved(node) = event {
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
        self.trail.push(Event::Graspable(node));
        if self.allowed[node as usize] {
            self.trail.push(Event::Moved(node));
        }
    }

    /// Steps of a [`Pace`](super::pace::Pace) for what was done since this was asked last.
    pub(super) fn steps(&mut self) -> usize {
        let steps = self.work / RULES_A_STEP;
        self.work %= RULES_A_STEP;
        steps
    }

    pub(super) fn mark(&self) -> Mark {
        Mark(self.trail.len())
    }

    /// Back to how it was at the mark.
    pub(super) fn undo(&mut self, mark: Mark) {
        for event in self.trail.drain(mark.0..).rev() {
            match event {
                Event::Allowed(node) => self.allowed[node as usize] = false,
                Event::Graspable(node) => self.graspable[node as usize] = false,
                Event::Moved(node) => {
                    self.work += self.problem.condition_of(node).len();
                    self.problem.condition_of(node).iter().for_each(|&rule| self.standing[rule as usize] += 1);
                }
            }
        }
        self.drawn = self.trail.len();
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

    /// Graspable, but not allowed to be moved: the only nodes whose permission changes anything.
    pub(super) fn is_frontier(&self, node: Node) -> bool {
        self.graspable[node as usize] && !self.allowed[node as usize]
    }

    /// What was moved, in order.
    pub(super) fn moved(&self) -> impl Iterator<Item = Node> + '_ {
        self.trail.iter().filter_map(|event| match event {
            Event::Moved(node) => Some(*node),
            _ => None,
        })
    }

    /// What became graspable since the mark.
    pub(super) fn graspable_since(&self, mark: Mark) -> impl Iterator<Item = Node> + '_ {
        self.trail[mark.0..].iter().filter_map(|event| match event {
            Event::Graspable(node) => Some(*node),
            _ => None,
        })
    }
}
