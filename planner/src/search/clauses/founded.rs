//! Nothing that holds only itself up: what is moved must be graspable by something else that is moved.

use core::cell::Cell;
use core::iter;
use std::rc::Rc;

use batsat::{Lit, Theory, TheoryArg, lbool};

use crate::search::problem::{Node, Problem};

/// Chains what is not refused yet, and objects where a moved node does not follow: it and the nodes that it waits for
/// need some rule from outside, and each of those is refused.
pub(super) struct Founded<'p> {
    problem: &'p Problem,
    /// Per node a literal: it is moved, or grasped if it is the target.
    nodes: Vec<Lit>,
    /// Per rule a literal: all of its body is moved.
    rules: Vec<Lit>,
    /// What may be in the set with nothing to make it graspable.
    excused: Vec<bool>,
    levels: usize,
    /// Per rule how many members of its body don't follow.
    standing: Vec<usize>,
    graspable: Vec<bool>,
    /// What waits for each other, and whether a node is among them.
    waiting: Vec<Node>,
    waits: Vec<bool>,
    /// Rules looked at since somebody paid for it.
    work: Rc<Cell<usize>>,
}

impl<'p> Founded<'p> {
    /// What it does is counted in `work`.
    pub(super) fn new(
        problem: &'p Problem,
        nodes: Vec<Lit>,
        rules: Vec<Lit>,
        excused: &[Node],
        work: Rc<Cell<usize>>,
    ) -> Self {
        let count = nodes.len();
        let mut founded = Self {
            problem,
            nodes,
            excused: vec![false; count],
            levels: 0,
            standing: vec![0; rules.len()],
            rules,
            graspable: vec![false; count],
            waiting: Vec::new(),
            waits: vec![false; count],
            work,
        };
        excused.iter().for_each(|&node| founded.excused[node as usize] = true);
        founded
    }

    fn rules(&self) -> impl Iterator<Item = u32> + use<> {
        0..u32::try_from(self.rules.len()).unwrap_or(u32::MAX)
    }

    fn count(&self, rules: usize) {
        self.work.set(self.work.get() + rules);
    }

    /// What can be grasped if all is moved that is not refused.
    fn chain(&mut self, solver: &TheoryArg<'_>) {
        let problem = self.problem;
        self.graspable.fill(false);
        self.count(self.rules.len());
        let mut moved = Vec::new();
        for rule in self.rules() {
            let body = problem.body(rule).len();
            self.standing[rule as usize] = body;
            if body == 0 {
                self.grasp(problem.head(rule), &mut moved, solver);
            }
        }
        while let Some(node) = moved.pop() {
            self.count(problem.condition_of(node).len());
            for &rule in problem.condition_of(node) {
                self.standing[rule as usize] -= 1;
                if self.standing[rule as usize] == 0 && !is_false(solver, self.rules[rule as usize]) {
                    self.grasp(problem.head(rule), &mut moved, solver);
                }
            }
        }
    }

    fn grasp(&mut self, node: Node, moved: &mut Vec<Node>, solver: &TheoryArg<'_>) {
        if !core::mem::replace(&mut self.graspable[node as usize], true) && !is_false(solver, self.nodes[node as usize])
        {
            moved.push(node);
        }
    }

    /// Why a node that does not follow can't be moved: some clause that is violated.
    fn objection(&mut self, node: Node, solver: &TheoryArg<'_>) -> Vec<Lit> {
        self.waiting.push(node);
        self.waits[node as usize] = true;
        let mut at = 0;
        while let Some(&node) = self.waiting.get(at) {
            at += 1;
            self.count(2 * self.problem.rules_of(node).len());
            for &rule in self.problem.rules_of(node) {
                let body = self.problem.body(rule);
                if body.iter().any(|&member| self.waits[member as usize]) || is_false(solver, self.rules[rule as usize])
                {
                    continue;
                }
                if let Some(&member) = body.iter().find(|&&member| !self.graspable[member as usize]) {
                    self.waits[member as usize] = true;
                    self.waiting.push(member);
                }
            }
        }
        let mut clause = vec![!self.nodes[node as usize]];
        for &rule in self.waiting.iter().flat_map(|&node| self.problem.rules_of(node)) {
            let body = self.problem.body(rule);
            if body.iter().any(|&member| self.waits[member as usize]) {
                continue;
            }
            let parts = iter::once(self.rules[rule as usize]).chain(body.iter().map(|&node| self.nodes[node as usize]));
            let refused = parts.into_iter().find(|&part| is_false(solver, part));
            clause.push(refused.expect("a rule whose body follows would make its head follow"));
        }
        self.waiting.drain(..).for_each(|node| self.waits[node as usize] = false);
        clause.sort_unstable();
        clause.dedup();
        clause
    }

    /// The shortest of the objections.
    fn object(&mut self, solver: &mut TheoryArg<'_>) {
        self.chain(solver);
        let mut shortest: Option<Vec<Lit>> = None;
        for node in 0..=self.problem.target() {
            let literal = self.nodes[node as usize];
            if self.graspable[node as usize] || self.excused[node as usize] || !is_false(solver, !literal) {
                continue;
            }
            let clause = self.objection(node, solver);
            if shortest.as_ref().is_none_or(|shortest| clause.len() < shortest.len()) {
                shortest = Some(clause);
            }
        }
        if let Some(clause) = shortest {
            solver.raise_conflict(&clause, true);
        }
    }
}

fn is_false(solver: &TheoryArg<'_>, literal: Lit) -> bool {
    solver.value(literal.var()) == if literal.sign() { lbool::FALSE } else { lbool::TRUE }
}

impl Theory for Founded<'_> {
    fn final_check(&mut self, solver: &mut TheoryArg<'_>) {
        self.object(solver);
    }

    fn partial_check(&mut self, solver: &mut TheoryArg<'_>) {
        self.object(solver);
    }

    fn create_level(&mut self) {
        self.levels += 1;
    }

    fn pop_levels(&mut self, levels: usize) {
        self.levels -= levels;
    }

    fn n_levels(&self) -> usize {
        self.levels
    }

    fn explain_propagation(&mut self, _: Lit) -> &[Lit] {
        // It only objects.
        &[]
    }
}
