//! A spatial index of discs: an R-tree over their bounding boxes. One large disc among many small ones slows down only
//! the queries near it.

use nalgebra::Point2;
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

use super::object::{Disc, ObjectIndex, distance};

/// An entry keeps the disc beside its bounds, so that a query needs no second look-up.
type Entry = GeomWithData<Rectangle<[f64; 2]>, (ObjectIndex, Disc)>;

/// The index of a scene's discs at the start.
#[derive(Debug, Clone)]
pub struct DiscIndex {
    tree: RTree<Entry>,
}

impl DiscIndex {
    /// Index `discs`; the n-th is [`ObjectIndex`] n.
    pub fn new(discs: impl IntoIterator<Item = Disc>) -> Self {
        let entries = discs.into_iter().enumerate().map(|(position, disc)| {
            let (c, r) = (disc.centre, disc.radius);
            let bounds = Rectangle::from_corners([c.x - r, c.y - r], [c.x + r, c.y + r]);
            GeomWithData::new(bounds, (ObjectIndex::new(position), disc))
        });
        Self { tree: RTree::bulk_load(entries.collect()) }
    }

    /// The objects whose discs come nearer than `reach` to `centre` (edge to point, m), in no particular order.
    pub fn within(&self, centre: Point2<f64>, reach: f64) -> impl Iterator<Item = (ObjectIndex, Disc)> + '_ {
        let corner = |sign: f64| [centre.x + sign * reach, centre.y + sign * reach];
        self.tree
            .locate_in_envelope_intersecting(AABB::from_corners(corner(-1.0), corner(1.0)))
            .map(|entry| entry.data)
            .filter(move |(_, disc)| distance(disc.centre, centre) < reach + disc.radius)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_index_finds_what_a_scan_finds() {
        let discs: Vec<Disc> = (0..400_u32)
            .map(|n| Disc {
                centre: Point2::new(f64::from(n * 37 % 101) / 50.0 - 1.0, f64::from(n * 53 % 97) / 50.0),
                radius: if n % 29 == 0 { 0.3 } else { 0.001 * f64::from(n % 7 + 1) },
            })
            .collect();
        let index = DiscIndex::new(discs.iter().copied());
        for n in 0..50_u32 {
            let centre = Point2::new(f64::from(n) / 25.0 - 1.0, f64::from(n * 7 % 50) / 25.0);
            let mut found: Vec<_> = index.within(centre, 0.1).map(|(object, _)| object).collect();
            found.sort_unstable();
            let scan = discs.iter().enumerate().filter(|(_, d)| distance(d.centre, centre) - d.radius < 0.1);
            assert_eq!(found, scan.map(|(i, _)| ObjectIndex::new(i)).collect::<Vec<_>>());
        }
    }
}
