//! Which drop-off takes each object that is taken away.
//!
//! Drop-offs that accept some objects only, or hold some only, make this a bipartite matching with capacities. It grows by
//! augmenting paths (Kuhn 1955): an object that is at a full drop-off moves on to another one where that makes room.

use std::collections::{HashMap, VecDeque};
use std::rc::Rc;

use crate::scene::{ObjectIndex, Scene};

/// Objects at drop-offs, each at one that accepts it, none over its capacity.
#[derive(Clone)]
pub struct DropOffs<'a> {
    scene: &'a Scene,
    takers: Rc<Takers>,
    /// Per drop-off what it holds.
    held: Vec<Vec<ObjectIndex>>,
    /// Drop-offs that stay full: no further path makes room there, since objects are only added.
    full: Vec<bool>,
}

/// The drop-offs that accept each object.
struct Takers {
    /// Those that accept any object.
    any: Vec<usize>,
    /// Per object those that name it. Only looked up.
    named: HashMap<ObjectIndex, Vec<usize>>,
}

/// How a path reached a drop-off: with this object, from the drop-off where it is.
#[derive(Clone, Copy)]
struct Hop {
    object: ObjectIndex,
    from: Option<usize>,
}

/// Objects and drop-offs that are looked at for one unit of work.
const LOOKS: usize = 16;

impl<'a> DropOffs<'a> {
    /// The empty drop-offs of a scene.
    pub fn new(scene: &'a Scene) -> Self {
        let (mut any, mut named) = (Vec::new(), HashMap::<_, Vec<usize>>::new());
        for (at, drop_off) in scene.drop_offs().iter().enumerate() {
            match drop_off.accepts() {
                Some(objects) => objects.iter().for_each(|&object| named.entry(object).or_default().push(at)),
                None => any.push(at),
            }
        }
        let count = scene.drop_offs().len();
        let takers = Rc::new(Takers { any, named });
        Self { scene, takers, held: vec![Vec::new(); count], full: vec![false; count] }
    }

    /// Takes one object more. False if there is no room for it, however the others are distributed; then nothing changes.
    /// `charge` is told of the work, in units of less than a microsecond.
    ///
    /// # Errors
    /// That of `charge`.
    pub fn take<E>(&mut self, object: ObjectIndex, mut charge: impl FnMut(usize) -> Result<(), E>) -> Result<bool, E> {
        let takers = Rc::clone(&self.takers);
        let named = |object: ObjectIndex| takers.named.get(&object).map_or(&[][..], Vec::as_slice);
        let mut hops: Vec<Option<Hop>> = vec![None; self.held.len()];
        let mut open = VecDeque::new();
        // The caller's order decides.
        let mut accepting: Vec<usize> = takers.any.iter().chain(named(object)).copied().collect();
        accepting.sort_unstable();
        charge(1 + accepting.len() / LOOKS)?;
        let mut free = self.reach(Hop { object, from: None }, &accepting, &mut hops, &mut open);
        let mut looks = 0;
        while let Some(at) = open.pop_front().filter(|_| free.is_none()) {
            for place in 0..self.held[at].len() {
                let other = self.held[at][place];
                let hop = Hop { object: other, from: Some(at) };
                looks += 1 + named(other).len();
                // Those that accept any object were reached by the first hop.
                free = self.reach(hop, named(other), &mut hops, &mut open);
                if free.is_some() {
                    break;
                }
            }
            charge(core::mem::take(&mut looks) / LOOKS)?;
        }
        match free {
            Some(free) => self.shift(free, &hops),
            None => hops.iter().zip(&mut self.full).for_each(|(hop, full)| *full |= hop.is_some()),
        }
        Ok(free.is_some())
    }

    /// Notes the drop-offs to which the object of the hop can go. Returns the first with room.
    fn reach(
        &self,
        hop: Hop,
        accepting: &[usize],
        hops: &mut [Option<Hop>],
        open: &mut VecDeque<usize>,
    ) -> Option<usize> {
        for &at in accepting {
            if self.full[at] || hops[at].is_some() {
                continue;
            }
            hops[at] = Some(hop);
            if self.scene.drop_offs()[at].capacity().is_none_or(|capacity| (self.held[at].len() as u64) < capacity) {
                return Some(at);
            }
            open.push_back(at);
        }
        None
    }

    /// Moves each object of the path on by one drop-off.
    fn shift(&mut self, free: usize, hops: &[Option<Hop>]) {
        let mut at = free;
        while let Some(Hop { object, from }) = hops[at] {
            self.held[at].push(object);
            let Some(from) = from else { return };
            self.held[from].retain(|&other| other != object);
            at = from;
        }
    }

    /// Per object of the scene the drop-off that holds it.
    pub fn places(&self) -> Vec<Option<usize>> {
        let mut places = vec![None; self.scene.objects().len()];
        for (at, objects) in self.held.iter().enumerate() {
            objects.iter().for_each(|object| places[object.get()] = Some(at));
        }
        places
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::scenes::TestScene;

    fn scene(drop_offs: &[(u32, Option<&[&str]>)]) -> Scene {
        let mut scene = TestScene::new(3);
        for n in 0..4_u8 {
            scene = scene.disc(&format!("d{n}"), 0.3 * f64::from(n) + 0.2, 0.5, 0.05);
        }
        for (at, (capacity, accepts)) in drop_offs.iter().enumerate() {
            scene = scene.drop_off(&format!("t{at}"), Some(*capacity), *accepts);
        }
        scene.build("d0")
    }

    fn take(drop_offs: &mut DropOffs<'_>, at: usize) -> bool {
        drop_offs.take(ObjectIndex::new(at), |_| Ok::<(), ()>(())).unwrap()
    }

    fn takes(scene: &Scene, order: &[usize]) -> Vec<bool> {
        let mut drop_offs = DropOffs::new(scene);
        let taken: Vec<bool> = order.iter().map(|&at| take(&mut drop_offs, at)).collect();
        for (at, held) in drop_offs.held.iter().enumerate() {
            let drop_off = &scene.drop_offs()[at];
            assert!(drop_off.capacity().is_none_or(|capacity| held.len() as u64 <= capacity));
            assert!(held.iter().all(|object| drop_off.accepts().is_none_or(|accepted| accepted.contains(object))));
        }
        assert_eq!(drop_offs.places().iter().flatten().count(), taken.iter().filter(|taken| **taken).count());
        taken
    }

    #[test]
    fn an_object_moves_on_where_that_makes_room() {
        let scene = scene(&[(1, None), (2, Some(&["d0", "d1"])), (1, Some(&["d1", "d2"]))]);
        // d0 goes to t0 and moves on for d3; d1 goes to t1 and moves on for nobody.
        assert_eq!(takes(&scene, &[0, 1, 3, 2]), [true; 4]);
    }

    #[test]
    fn the_first_drop_off_with_room_takes_it() {
        let scene = scene(&[(1, Some(&["d0", "d1"])), (4, None)]);
        let mut drop_offs = DropOffs::new(&scene);
        assert!((0..3).all(|at| take(&mut drop_offs, at)));
        assert_eq!(drop_offs.places(), [Some(0), Some(1), Some(1), None]);
    }

    #[test]
    fn what_has_no_room_is_refused_and_others_are_still_taken() {
        let scene = scene(&[(1, Some(&["d0", "d1"])), (1, Some(&["d2"]))]);
        assert_eq!(takes(&scene, &[0, 1, 3, 2]), [true, false, false, true]);
    }
}
