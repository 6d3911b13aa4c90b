//! A spatial index of footprints: an R-tree over their bounding boxes. A large one among many small ones slows down only
//! the queries near it.

use nalgebra::Point2;
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

use super::footprint::Footprint;
use super::object::ObjectIndex;

/// An entry keeps the footprint beside its bounds, so that a query needs no second look-up.
type IndexEntry = GeomWithData<Rectangle<[f64; 2]>, (ObjectIndex, Footprint)>;

/// The index of a scene's objects at the start.
#[derive(Debug, Clone)]
pub struct FootprintIndex {
    tree: RTree<IndexEntry>,
}

impl FootprintIndex {
    /// Index `footprints`; the n-th is [`ObjectIndex`] n.
    pub fn new(footprints: impl IntoIterator<Item = Footprint>) -> Self {
        let entries = footprints.into_iter().enumerate().map(|(position, footprint)| {
            let [min, max] = footprint.bounding_box();
            let bounds = Rectangle::from_corners([min.x, min.y], [max.x, max.y]);
            GeomWithData::new(bounds, (ObjectIndex::new(position), footprint))
        });
        Self { tree: RTree::bulk_load(entries.collect()) }
    }

    /// The objects that come nearer than `reach` to `centre` (edge to point, m), in no particular order.
    pub fn within(&self, centre: Point2<f64>, reach: f64) -> impl Iterator<Item = (ObjectIndex, &Footprint)> {
        let corner = |sign: f64| [centre.x + sign * reach, centre.y + sign * reach];
        self.tree
            .locate_in_envelope_intersecting(AABB::from_corners(corner(-1.0), corner(1.0)))
            .map(|entry| (entry.data.0, &entry.data.1))
            .filter(move |(_, footprint)| footprint.comes_within(centre, reach))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::distance;

    #[test]
    fn the_index_finds_what_a_scan_finds() {
        let discs: Vec<Footprint> = (0..400_u32)
            .map(|n| {
                let centre = Point2::new(f64::from(n * 37 % 101) / 50.0 - 1.0, f64::from(n * 53 % 97) / 50.0);
                Footprint::disc(centre, if n % 29 == 0 { 0.3 } else { 0.001 * f64::from(n % 7 + 1) })
            })
            .collect();
        let index = FootprintIndex::new(discs.iter().cloned());
        for n in 0..50_u32 {
            let centre = Point2::new(f64::from(n) / 25.0 - 1.0, f64::from(n * 7 % 50) / 25.0);
            let mut found: Vec<_> = index.within(centre, 0.1).map(|(object, _)| object).collect();
            found.sort_unstable();
            let scan =
                discs.iter().enumerate().filter(|(_, disc)| distance(disc.at(), centre) - disc.circumradius() < 0.1);
            assert_eq!(found, scan.map(|(i, _)| ObjectIndex::new(i)).collect::<Vec<_>>());
        }
    }
}
