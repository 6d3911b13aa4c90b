//! Unfounded sets, as in answer set programming (Gebser, Kaufmann & Schaub 2012): nodes that are moved but only support
//! each other. A moved node needs a rule from outside its cycle.

use core::cell::Cell;
use core::iter;
use std::rc::Rc;

use batsat::{Lit, Theory, TheoryArg, lbool};

use crate::search::problem::{HornRules, Node};

/// A theory of the solver. It chains forward over all that is not assigned false. A node that is moved but not derived
/// lies in an unfounded set, and the shortest loop nogood of these sets is a conflict.
pub(super) struct UnfoundedSets<'p> {
    problem: &'p HornRules,
    /// Per node the literal "it is moved"; for the target "it is grasped".
    nodes: Vec<Lit>,
    /// Per rule the literal "its whole body is moved".
    rules: Vec<Lit>,
    /// Per node whether it may be moved although no rule derives it, because a restriction requires it.
    underived_required: Vec<bool>,
    levels: usize,
    /// Per rule the number of members of its body that are not derived.
    standing: Vec<usize>,
    graspable: Vec<bool>,
    /// The unfounded set under construction.
    unfounded: Vec<Node>,
    /// Per node whether it is in that set.
    is_unfounded: Vec<bool>,
    /// Rules read that the ticker has not counted yet.
    work: Rc<Cell<usize>>,
}

impl<'p> UnfoundedSets<'p> {
    /// The theory of a problem; it counts its work in `work`.
    pub(super) fn new(
        problem: &'p HornRules,
        nodes: Vec<Lit>,
        rules: Vec<Lit>,
        underived_required: &[Node],
        work: Rc<Cell<usize>>,
    ) -> Self {
        let count = nodes.len();
        let mut theory = Self {
            problem,
            nodes,
            underived_required: vec![false; count],
            levels: 0,
            standing: vec![0; rules.len()],
            rules,
            graspable: vec![false; count],
            unfounded: Vec::new(),
            is_unfounded: vec![false; count],
            work,
        };
        underived_required.iter().for_each(|&node| theory.underived_required[node as usize] = true);
        theory
    }

    fn rules(&self) -> impl Iterator<Item = u32> + use<> {
        0..u32::try_from(self.rules.len()).unwrap_or(u32::MAX)
    }

    fn count(&self, rules: usize) {
        self.work.set(self.work.get() + rules);
    }

    /// Finds what is graspable when every node is moved that is not assigned false.
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

    /// The loop nogood of an unfounded set that holds `node`: if `node` is moved, some external body of the set holds.
    /// The current assignment violates this clause.
    fn loop_nogood(&mut self, node: Node, solver: &TheoryArg<'_>) -> Vec<Lit> {
        self.unfounded.push(node);
        self.is_unfounded[node as usize] = true;
        let mut at = 0;
        while let Some(&node) = self.unfounded.get(at) {
            at += 1;
            self.count(2 * self.problem.rules_of(node).len());
            for &rule in self.problem.rules_of(node) {
                let body = self.problem.body(rule);
                if body.iter().any(|&member| self.is_unfounded[member as usize])
                    || is_false(solver, self.rules[rule as usize])
                {
                    continue;
                }
                if let Some(&member) = body.iter().find(|&&member| !self.graspable[member as usize]) {
                    self.is_unfounded[member as usize] = true;
                    self.unfounded.push(member);
                }
            }
        }
        let mut clause = vec![!self.nodes[node as usize]];
        for &rule in self.unfounded.iter().flat_map(|&node| self.problem.rules_of(node)) {
            let body = self.problem.body(rule);
            if body.iter().any(|&member| self.is_unfounded[member as usize]) {
                continue;
            }
            let parts = iter::once(self.rules[rule as usize]).chain(body.iter().map(|&node| self.nodes[node as usize]));
            let falsified = parts.into_iter().find(|&part| is_false(solver, part));
            clause.push(falsified.expect("a rule whose body follows would make its head follow"));
        }
        self.unfounded.drain(..).for_each(|node| self.is_unfounded[node as usize] = false);
        clause.sort_unstable();
        clause.dedup();
        clause
    }

    /// Raises the shortest loop nogood as a conflict.
    fn check(&mut self, solver: &mut TheoryArg<'_>) {
        self.chain(solver);
        let mut shortest: Option<Vec<Lit>> = None;
        for node in 0..=self.problem.target() {
            let literal = self.nodes[node as usize];
            if self.graspable[node as usize] || self.underived_required[node as usize] || !is_false(solver, !literal) {
                continue;
            }
            let clause = self.loop_nogood(node, solver);
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

impl Theory for UnfoundedSets<'_> {
    fn final_check(&mut self, solver: &mut TheoryArg<'_>) {
        self.check(solver);
    }

    fn partial_check(&mut self, solver: &mut TheoryArg<'_>) {
        self.check(solver);
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
        // It only raises conflicts and never propagates.
        &[]
    }
}
