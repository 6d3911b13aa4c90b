//! The Horn rules of one question, densely numbered.

use crate::budget::{Interrupted, Ticker};
use crate::knowledge::{KnowledgeBase, Rows};
use crate::scene::ObjectIndex;

/// An object of the problem; the target is numbered after all others.
pub(super) type Node = u32;

/// Members of bodies read per step of the ticker.
pub(super) const MEMBERS_A_STEP: usize = 64;

/// Horn rules over nodes.
#[derive(Debug)]
pub(super) struct HornRules {
    /// Node to object, the target last.
    objects: Vec<ObjectIndex>,
    /// Per rule its head.
    heads: Vec<Node>,
    /// Per node its rules.
    rules_of: Rows<u32>,
    bodies: Rows<u32>,
    condition_of: Rows<u32>,
}

impl HornRules {
    /// The rules of `objects` (the target last) whose bodies are `usable`. These bodies must name no other object.
    pub(super) fn over(
        base: &KnowledgeBase,
        objects: Vec<ObjectIndex>,
        usable: impl Fn(&[ObjectIndex]) -> bool,
        ticker: &mut Ticker<'_>,
    ) -> Result<Self, Interrupted> {
        let mut node_of = vec![Node::MAX; base.len()];
        objects.iter().zip(0..).for_each(|(object, node)| node_of[object.get()] = node);
        let (mut heads, mut members): (Vec<Node>, Vec<(u32, Node)>) = (Vec::new(), Vec::new());
        for &object in &objects {
            let mut read = 0;
            for option in base.options(object) {
                read += 1 + option.len();
                if !usable(option) {
                    continue;
                }
                #[expect(clippy::cast_possible_truncation, reason = "a base has fewer than 2^32 rules")]
                let rule = heads.len() as u32;
                heads.push(node_of[object.get()]);
                members.extend(option.iter().map(|member| (rule, node_of[member.get()])));
            }
            ticker.step(1 + read / MEMBERS_A_STEP)?;
        }
        ticker.step(members.len() / MEMBERS_A_STEP)?;
        Ok(Self::from_parts(objects, heads, &members))
    }

    /// The part on which the target depends through `kept` rules. Breadth-first backwards from the target, numbered in
    /// reverse, so that nodes near the target have high numbers. Also returns per node its new number, if it is left.
    pub(super) fn restricted(
        &self,
        kept: impl Fn(u32, &mut Ticker<'_>) -> Result<bool, Interrupted>,
        ticker: &mut Ticker<'_>,
    ) -> Result<(Self, Vec<Option<Node>>), Interrupted> {
        let (mut seen, mut is_kept) = (vec![false; self.objects.len()], vec![false; self.rules()]);
        seen[self.target() as usize] = true;
        let mut order = vec![self.target()];
        let mut at = 0;
        while let Some(&node) = order.get(at) {
            at += 1;
            ticker.step(1 + self.rules_of(node).len() / 8)?;
            for &rule in self.rules_of(node) {
                is_kept[rule as usize] = kept(rule, ticker)?;
                let body = if is_kept[rule as usize] { self.body(rule) } else { &[] };
                for &member in body {
                    if !core::mem::replace(&mut seen[member as usize], true) {
                        order.push(member);
                    }
                }
            }
        }
        order.reverse();
        let mut number = vec![None; self.objects.len()];
        order.iter().zip(0..).for_each(|(&node, new)| number[node as usize] = Some(new));
        let (mut heads, mut members): (Vec<Node>, Vec<(u32, Node)>) = (Vec::new(), Vec::new());
        for (&node, head) in order.iter().zip(0..) {
            ticker.step(1 + self.rules_of(node).len() / 8)?;
            for &rule in self.rules_of(node).iter().filter(|&&rule| is_kept[rule as usize]) {
                #[expect(clippy::cast_possible_truncation, reason = "a base has fewer than 2^32 rules")]
                let new = heads.len() as u32;
                heads.push(head);
                members.extend(self.body(rule).iter().filter_map(|&member| Some((new, number[member as usize]?))));
            }
        }
        ticker.step(members.len() / MEMBERS_A_STEP)?;
        let objects = order.iter().map(|&node| self.objects[node as usize]).collect();
        Ok((Self::from_parts(objects, heads, &members), number))
    }

    fn from_parts(objects: Vec<ObjectIndex>, heads: Vec<Node>, members: &[(u32, Node)]) -> Self {
        let bodies = Rows::from_pairs(heads.len(), members.iter().copied());
        let condition_of = Rows::from_pairs(objects.len(), members.iter().map(|&(rule, node)| (node, rule)));
        let rules_of = Rows::from_pairs(objects.len(), heads.iter().copied().zip(0..));
        Self { objects, heads, rules_of, bodies, condition_of }
    }

    /// The number of nodes besides the target.
    pub(super) fn movable(&self) -> usize {
        self.objects.len() - 1
    }

    pub(super) fn target(&self) -> Node {
        #[expect(clippy::cast_possible_truncation, reason = "a scene holds fewer than 2^32 objects")]
        let last = self.movable() as Node;
        last
    }

    pub(super) fn rules(&self) -> usize {
        self.heads.len()
    }

    pub(super) fn head(&self, rule: u32) -> Node {
        self.heads[rule as usize]
    }

    pub(super) fn rules_of(&self, node: Node) -> &[u32] {
        self.rules_of.get(node as usize)
    }

    pub(super) fn body(&self, rule: u32) -> &[Node] {
        self.bodies.get(rule as usize)
    }

    pub(super) fn condition_of(&self, node: Node) -> &[u32] {
        self.condition_of.get(node as usize)
    }

    pub(super) fn object(&self, node: Node) -> ObjectIndex {
        self.objects[node as usize]
    }

    pub(super) fn node(&self, object: ObjectIndex) -> Option<Node> {
        self.objects.iter().zip(0..).find(|(other, _)| **other == object).map(|(_, node)| node)
    }
}
