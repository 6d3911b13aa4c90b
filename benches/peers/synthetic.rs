//! Bases without a scene, made to hurt a search by landmarks and hitting sets.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use singulate_planner::knowledge::KnowledgeBase;
use singulate_planner::scene::ObjectIndex;

use super::instances::Instance;

/// Vertices and edges of random graphs.
const GRAPHS: [(usize, usize); 8] =
    [(40, 80), (40, 200), (60, 120), (60, 300), (80, 160), (100, 150), (100, 200), (120, 180)];
/// Elements, sets, and members of each set.
const SYSTEMS: [(usize, usize, usize); 6] =
    [(30, 60, 3), (40, 80, 4), (50, 60, 3), (60, 80, 4), (80, 100, 3), (100, 80, 5)];
/// Objects, options of each, members of each option, percent of objects that are free.
const WEBS: [(usize, usize, usize, usize); 6] =
    [(40, 2, 2, 30), (60, 2, 2, 30), (80, 2, 2, 30), (60, 3, 2, 15), (60, 3, 3, 35), (200, 2, 2, 45)];
/// Layers, objects of each, options of each object.
const STACKS: [(usize, usize, usize); 4] = [(4, 15, 2), (5, 20, 2), (6, 20, 3), (8, 20, 2)];
/// How many members the target's options have.
const WIDE: usize = 6;
/// Percent of a stack's members that are one of the layers above.
const UPWARDS: usize = 15;

type Options = Vec<Vec<Vec<usize>>>;

/// Vertex covers, hitting sets, webs and stacks in turn, each of several sizes.
pub(crate) fn synthetic(number: usize) -> Instance {
    let (kind, at) = (number % 4, number / 4);
    let mut random = ChaCha8Rng::seed_from_u64(u64::try_from(number).expect("small"));
    let (name, options) = match kind {
        0 => {
            let (vertices, edges) = GRAPHS[at % GRAPHS.len()];
            (format!("vertex cover: {vertices} vertices, {edges} edges"), system(&mut random, (vertices, edges, 2)))
        }
        1 => {
            let (elements, sets, members) = SYSTEMS[at % SYSTEMS.len()];
            (
                format!("hitting set: {sets} sets of {members} of {elements}"),
                system(&mut random, (elements, sets, members)),
            )
        }
        2 => {
            let (objects, options, members, free) = WEBS[at % WEBS.len()];
            (
                format!("web: {objects} objects, {options}×{members}, {free} % free"),
                web(&mut random, WEBS[at % WEBS.len()]),
            )
        }
        _ => {
            let (layers, width, options) = STACKS[at % STACKS.len()];
            (
                format!("stack: {layers}×{width} objects, {options} options"),
                stack(&mut random, STACKS[at % STACKS.len()]),
            )
        }
    };
    let object = |members: Vec<usize>| members.into_iter().map(ObjectIndex::new).collect();
    let base: KnowledgeBase =
        options.into_iter().map(|list| list.into_iter().map(object).collect::<Vec<_>>()).collect();
    Instance { name: format!("{name}, seed {number}"), base, target: ObjectIndex::new(0), knowledge: None }
}

/// A number below `count`.
fn below(random: &mut ChaCha8Rng, count: usize) -> usize {
    random.random_range(0..u32::try_from(count).expect("small")) as usize
}

/// Different numbers below `count`, `not` this one.
fn some(random: &mut ChaCha8Rng, count: usize, wanted: usize, not: Option<usize>) -> Vec<usize> {
    let mut drawn = Vec::with_capacity(wanted);
    while drawn.len() < wanted {
        let next = below(random, count);
        if !drawn.contains(&next) && Some(next) != not {
            drawn.push(next);
        }
    }
    drawn
}

/// t ← {s₁ … sₘ}, s ← {e} for each element e of s, elements free: every set is needed, and a least hitting set besides.
/// With two elements a set these are graphs, and a least hitting set is a least vertex cover.
fn system(random: &mut ChaCha8Rng, (elements, sets, members): (usize, usize, usize)) -> Options {
    let first = sets + 1;
    let mut options = vec![vec![(1..first).collect()]];
    let set = |random: &mut ChaCha8Rng| some(random, elements, members, None).iter().map(|e| vec![first + e]).collect();
    options.extend((0..sets).map(|_| set(random)));
    options.extend((0..elements).map(|_| vec![Vec::new()]));
    options
}

/// Every object needs some of any others: cycles, and derivations that share what they need.
fn web(random: &mut ChaCha8Rng, (objects, options, members, free): (usize, usize, usize, usize)) -> Options {
    let object = |at: usize| {
        if at > 0 && below(random, 100) < free {
            return vec![Vec::new()];
        }
        let members = if at == 0 { WIDE } else { members };
        (0..options).map(|_| some(random, objects, members, Some(at))).collect()
    };
    (0..objects).map(object).collect()
}

/// Each object needs two of the layer below, or now and then one further up; the lowest layer is free.
fn stack(random: &mut ChaCha8Rng, (layers, width, options): (usize, usize, usize)) -> Options {
    let in_layer = |layer: usize, column: usize| 1 + layer * width + column;
    let mut all = vec![vec![some(random, width, WIDE, None).into_iter().map(|column| in_layer(0, column)).collect()]];
    for layer in 0..layers {
        for column in 0..width {
            let mut member = || loop {
                let upwards = below(random, 100) < UPWARDS;
                let other = if upwards { below(random, layer + 1) } else { layer + 1 };
                let member = in_layer(other, below(random, width));
                if member != in_layer(layer, column) {
                    return member;
                }
            };
            let last = layer + 1 == layers;
            all.push(if last { vec![Vec::new()] } else { (0..options).map(|_| vec![member(), member()]).collect() });
        }
    }
    all
}
