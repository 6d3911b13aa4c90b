//! Places the discs of a generated scene.

use std::cmp::Ordering;
use std::collections::{BinaryHeap, HashMap};

use nalgebra::{Point2, Vector2};
use rand_chacha::ChaCha8Rng;

use super::recipe::{Crowding, GenerateError, Recipe, between, whole_micrometres};
use singulate_planner::scene::distance;

/// A disc on the floor, before it is an object of a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Disc {
    /// m.
    pub(super) centre: Point2<f64>,
    /// m.
    pub(super) radius: f64,
}

/// Draws of a place for one disc before the attempt is given up.
const TRIES: usize = 2_000;
/// Restarts with an empty table.
const ATTEMPTS: usize = 30;
/// Rounding to whole micrometres moves a centre by up to 0.71 µm; with this extra distance, rounded discs never
/// overlap.
const ROUNDING: f64 = 1e-6;

/// As many discs as the recipe asks for.
///
/// The random numbers of an attempt don't depend on the count: a number of discs that fitted once fits again.
pub(super) fn discs(recipe: &Recipe, random: &mut ChaCha8Rng) -> Result<Vec<Disc>, GenerateError> {
    let mut fitted = 0;
    for _ in 0..ATTEMPTS {
        let floor = match recipe.arrangement {
            Crowding::Loose => loose(recipe, random),
            Crowding::Pressed => pressed(recipe, random),
        };
        if floor.discs.len() == recipe.objects {
            return Ok(floor.discs);
        }
        fitted = fitted.max(floor.discs.len());
    }
    Err(GenerateError::TooFull { fitted, wanted: recipe.objects })
}

/// The discs placed so far, in a grid of cells so wide that touching discs are in neighbouring cells.
struct Floor {
    min: Point2<f64>,
    max: Point2<f64>,
    cell: f64,
    cells: HashMap<(i64, i64), Vec<usize>>,
    discs: Vec<Disc>,
}

impl Floor {
    fn new(recipe: &Recipe) -> Self {
        let (min, max) = recipe.corners();
        let cell = 2.0 * recipe.radius.1 + recipe.pressed_gap + 2.0 * ROUNDING;
        Self { min, max, cell, cells: HashMap::new(), discs: Vec::new() }
    }

    fn cell_of(&self, at: Point2<f64>) -> (i64, i64) {
        let number = |value: f64, from: f64| {
            #[expect(clippy::cast_possible_truncation, reason = "a table has fewer than 2^63 cells")]
            let cell = ((value - from) / self.cell).floor() as i64;
            cell
        };
        (number(at.x, self.min.x), number(at.y, self.min.y))
    }

    /// The discs in the cells up to `span` away.
    fn near(&self, at: Point2<f64>, span: i64) -> impl Iterator<Item = Disc> + '_ {
        let (column, row) = self.cell_of(at);
        (column - span..=column + span)
            .flat_map(move |x| (row - span..=row + span).map(move |y| (x, y)))
            .filter_map(|cell| self.cells.get(&cell))
            .flatten()
            .map(|&disc| self.discs[disc])
    }

    /// Put the disc there if it is on the table and clear of the others.
    fn put(&mut self, disc: Disc) -> bool {
        let (c, r) = (disc.centre, disc.radius);
        let on_table = c.x - r >= self.min.x && c.y - r >= self.min.y && c.x + r <= self.max.x && c.y + r <= self.max.y;
        if !on_table || self.near(c, 1).any(|other| distance(c, other.centre) - r - other.radius < 0.0) {
            return false;
        }
        self.cells.entry(self.cell_of(c)).or_default().push(self.discs.len());
        self.discs.push(disc);
        true
    }

    /// Put a disc of a random radius at a random place, if it fits.
    fn put_anywhere(&mut self, recipe: &Recipe, random: &mut ChaCha8Rng) -> bool {
        let radius = whole_micrometres(between(random, recipe.radius));
        (0..TRIES).any(|_| {
            let x = between(random, (self.min.x + radius, self.max.x - radius));
            let y = between(random, (self.min.y + radius, self.max.y - radius));
            self.put(Disc { centre: rounded(Point2::new(x, y)), radius })
        })
    }
}

fn rounded(point: Point2<f64>) -> Point2<f64> {
    Point2::new(whole_micrometres(point.x), whole_micrometres(point.y))
}

/// Rejection sampling.
fn loose(recipe: &Recipe, random: &mut ChaCha8Rng) -> Floor {
    let mut floor = Floor::new(recipe);
    while floor.discs.len() < recipe.objects && floor.put_anywhere(recipe, random) {}
    floor
}

/// A place that touches two discs of the cluster.
struct Candidate {
    disc: Disc,
    /// From the cluster's centre, m.
    distance: f64,
    /// Order of discovery, to break ties.
    number: usize,
}

impl Ord for Candidate {
    /// The candidate nearest to the cluster's centre is the greatest, so that a `BinaryHeap` pops it first.
    fn cmp(&self, other: &Self) -> Ordering {
        other.distance.total_cmp(&self.distance).then(other.number.cmp(&self.number))
    }
}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Candidate {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Candidate {}

/// A cluster that grows from its centre: of all places that touch two of its discs, the one nearest to the centre is
/// taken. Discs are never removed, so a blocked place stays blocked. Each place has its own radius: small discs fit
/// more often, so a mixed cluster holds more small ones than large ones.
fn pressed(recipe: &Recipe, random: &mut ChaCha8Rng) -> Floor {
    let mut floor = Floor::new(recipe);
    if !floor.put_anywhere(recipe, random) {
        return floor;
    }
    let first = floor.discs[0];
    let second = beside(first, recipe, random);
    let mut places = BinaryHeap::from([Candidate { distance: 0.0, number: 0, disc: second }]);
    let mut number = 1;
    while floor.discs.len() < recipe.objects {
        let Some(Candidate { disc, .. }) = places.pop() else { return floor };
        if !floor.put(disc) {
            // The second disc may hang over the table's edge: try another side.
            if floor.discs.len() == 1 && number < TRIES {
                let disc = beside(first, recipe, random);
                places.push(Candidate { distance: 0.0, number, disc });
                number += 1;
            }
            continue;
        }
        // Two discs with one between them are at most two diameters and two gaps apart: two cells.
        for other in floor.near(disc.centre, 2).filter(|other| *other != disc) {
            for left in [true, false] {
                let radius = whole_micrometres(between(random, recipe.radius));
                let gaps = (between(random, (0.0, recipe.pressed_gap)), between(random, (0.0, recipe.pressed_gap)));
                let Some(centre) = touching(disc, other, radius, gaps, left) else { continue };
                let distance = distance(centre, first.centre);
                places.push(Candidate { disc: Disc { centre: rounded(centre), radius }, distance, number });
                number += 1;
            }
        }
    }
    floor
}

/// A disc next to `first`, at a uniformly random angle.
fn beside(first: Disc, recipe: &Recipe, random: &mut ChaCha8Rng) -> Disc {
    let direction = loop {
        // A point of the unit disc gives a direction without trigonometry.
        let point = Vector2::new(between(random, (-1.0, 1.0)), between(random, (-1.0, 1.0)));
        let length = (point.x * point.x + point.y * point.y).sqrt();
        if (0.1..=1.0).contains(&length) {
            break point / length;
        }
    };
    let radius = whole_micrometres(between(random, recipe.radius));
    let apart = first.radius + radius + between(random, (0.0, recipe.pressed_gap)) + ROUNDING;
    Disc { centre: rounded(first.centre + direction * apart), radius }
}

/// The centre of a disc of `radius` with the given gaps to `a` and `b`, left or right of the line from a to b.
fn touching(a: Disc, b: Disc, radius: f64, gaps: (f64, f64), left: bool) -> Option<Point2<f64>> {
    let to_a = a.radius + radius + gaps.0 + ROUNDING;
    let to_b = b.radius + radius + gaps.1 + ROUNDING;
    let apart = distance(a.centre, b.centre);
    let along = (apart * apart + to_a * to_a - to_b * to_b) / (2.0 * apart);
    let square = to_a * to_a - along * along;
    if square < 0.0 {
        return None;
    }
    let across = if left { square.sqrt() } else { -square.sqrt() };
    let way = (b.centre - a.centre) / apart;
    Some(a.centre + way * along + Vector2::new(-way.y, way.x) * across)
}
