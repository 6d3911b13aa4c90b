//! The bound that the stated landmarks prove: each is checked by chaining, then a least hitting set of the sound ones
//! is computed.

use std::collections::HashMap;

use crate::budget::{Interrupted, Ticker};
use crate::cost::Cost;
use crate::scene::{ObjectIndex, Scene};

use super::allowed::Allowed;
use super::chain::{Chain, Reached};
use super::fault::{FaultCode, Faults};
use super::hitting::{MOST_KEPT, least_hits};
use super::names::ObjectNames;

/// The most lifted objects that a fault names.
const MAX_NAMED: usize = 5;

/// The proven bound.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Proof {
    /// No plan has fewer relocations.
    pub(super) bound: Cost,
    /// True if time sufficed: then `bound` is exactly what the landmarks prove.
    pub(super) complete: bool,
    /// The sound landmarks that prove `bound`, none a superset of another.
    pub(super) sound: Vec<Vec<ObjectIndex>>,
}

/// A readable landmark: its members, sorted, and its position in the answer.
struct Landmark {
    members: Vec<ObjectIndex>,
    at: usize,
}

/// Checks the landmarks, smallest first, and computes the bound of the sound ones.
pub(super) fn prove(
    scene: &Scene,
    stated: &[Vec<String>],
    (names, allowed): (&ObjectNames<'_>, &Allowed<'_>),
    chain: &mut Chain<'_>,
    faults: &mut Faults,
    ticker: &mut Ticker<'_>,
) -> Proof {
    let (mut sound, mut complete) = (Sound::default(), true);
    let tried = readable(scene, stated, (names, allowed), faults, ticker).and_then(|landmarks| {
        for landmark in landmarks {
            sound.try_one(scene, allowed, landmark, chain, faults, ticker)?;
        }
        Ok(())
    });
    complete &= tried.is_ok();
    let (sets, width) = sound.numbered();
    let hits = least_hits(sets, width, MOST_KEPT, ticker);
    // Every element costs one: each object is moved at least once.
    Proof { bound: Cost::of_each(hits.at_least), complete: complete && hits.exact, sound: sound.landmarks }
}

/// The landmarks whose members exist and are movable, smallest first. The others are faults.
fn readable(
    scene: &Scene,
    stated: &[Vec<String>],
    named: (&ObjectNames<'_>, &Allowed<'_>),
    faults: &mut Faults,
    ticker: &mut Ticker<'_>,
) -> Result<Vec<Landmark>, Interrupted> {
    let mut landmarks = Vec::new();
    for (at, ids) in stated.iter().enumerate() {
        ticker.step(1 + ids.len() / 8)?;
        let members: Option<Vec<ObjectIndex>> = ids.iter().map(|id| member(scene, at, id, named, faults)).collect();
        let Some(mut members) = members else { continue };
        members.sort_unstable();
        members.dedup();
        if members.is_empty() {
            faults.of_answer(FaultCode::BadLandmark, || format!("landmark {at} has no member"));
        } else {
            landmarks.push(Landmark { members, at });
        }
    }
    landmarks.sort_by(|a, b| a.members.len().cmp(&b.members.len()).then_with(|| a.members.cmp(&b.members)));
    Ok(landmarks)
}

fn member(
    scene: &Scene,
    at: usize,
    id: &str,
    (names, allowed): (&ObjectNames<'_>, &Allowed<'_>),
    faults: &mut Faults,
) -> Option<ObjectIndex> {
    let object = names.known(id, None, faults)?;
    if allowed.relocatable(scene, object) {
        return Some(object);
    }
    let why = match scene.goal().is_candidate(object) || scene.object(object).fixed() {
        true => "no plan relocates the target or a fixed object",
        false => "it can't be moved by any plan",
    };
    let detail = || format!("landmark {at} holds it, and {why}");
    faults.of_object(FaultCode::BadLandmark, id, detail);
    None
}

/// A sentence that describes how the goal is reached.
fn how(scene: &Scene, Reached { grasped, lifted }: &Reached) -> String {
    let named: Vec<_> =
        lifted.iter().take(MAX_NAMED).map(|object| format!("'{}'", scene.object(*object).id())).collect();
    let more = match lifted.len() - named.len() {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    let once = if named.is_empty() { String::new() } else { format!(" once {}{more} are lifted", named.join(", ")) };
    match grasped {
        Some((_, way)) if scene.target().is_some() => format!("{}{once}", way.frees("the target")),
        Some((object, way)) => format!("{}{once}", way.frees(&format!("'{}'", scene.object(*object).id()))),
        None => format!("all that is wanted can be taken away{once}"),
    }
}

/// The landmarks found sound, none a superset of another.
#[derive(Default)]
struct Sound {
    landmarks: Vec<Vec<ObjectIndex>>,
    /// Positions of the landmarks, by their first member.
    by_first: HashMap<ObjectIndex, Vec<usize>>,
}

impl Sound {
    /// Checks one landmark: it is sound if the goal is not reached while its members are held.
    fn try_one(
        &mut self,
        scene: &Scene,
        allowed: &Allowed<'_>,
        landmark: Landmark,
        chain: &mut Chain<'_>,
        faults: &mut Faults,
        ticker: &mut Ticker<'_>,
    ) -> Result<(), Interrupted> {
        let Landmark { members, at } = landmark;
        if self.covers(&members, ticker)? {
            return Ok(());
        }
        // What is to be taken away is held: no chaining reaches the goal.
        let held = members.iter().any(|member| scene.goal().wants_away(*member));
        let reached = if held { None } else { chain.reaches_goal(scene, allowed, &members, ticker)? };
        if let Some(reached) = reached {
            let detail = || format!("landmark {at} can be left as it stands: {}", how(scene, &reached));
            faults.of_answer(FaultCode::LandmarkRefuted, detail);
            return Ok(());
        }
        self.by_first.entry(members[0]).or_default().push(self.landmarks.len());
        self.landmarks.push(members);
        Ok(())
    }

    /// True if a sound landmark is a subset of `members`. Then `members` are a sound landmark too, and prove nothing
    /// more.
    fn covers(&self, members: &[ObjectIndex], ticker: &mut Ticker<'_>) -> Result<bool, Interrupted> {
        ticker.step(1 + members.len() / 50)?;
        for first in members {
            let Some(candidates) = self.by_first.get(first) else { continue };
            let mut compared = candidates.len();
            let within = |at: &usize| {
                let held = |member: &ObjectIndex| members.binary_search(member).is_ok();
                let count = self.landmarks[*at].iter().take_while(|member| held(member)).count();
                compared += count;
                count == self.landmarks[*at].len()
            };
            let covered = candidates.iter().any(within);
            ticker.step(1 + compared / 8)?;
            if covered {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// The landmarks with their members numbered from 0, and the number of different members.
    fn numbered(&self) -> (Vec<Vec<usize>>, usize) {
        let mut all: Vec<ObjectIndex> = self.landmarks.iter().flatten().copied().collect();
        all.sort_unstable();
        all.dedup();
        let number = |member: &ObjectIndex| all.partition_point(|other| other < member);
        let sets = self.landmarks.iter().map(|members| members.iter().map(number).collect());
        (sets.collect(), all.len())
    }
}

#[cfg(test)]
mod tests {
    use crate::budget::clocks::Looks;
    use crate::check::Checker;
    use crate::cost::Cost;
    use crate::scene::scenes::TestScene;
    use crate::scene::{GoalDraft, Scene};
    use crate::statement::Statement;

    /// Looks at the clock for the landmarks of so many loose objects that are all to be taken away.
    fn looks(count: u32) -> usize {
        let ids: Vec<String> = (0..count).map(|n| format!("d{n}")).collect();
        let mut scene = TestScene::new(3).table(f64::from(count), 1.0).drop_off("tray", None, None);
        for (n, id) in (0..).zip(&ids) {
            scene = scene.disc(id, f64::from(n) + 0.5, 0.5, 0.05);
        }
        let scene: Scene = scene.with_goal(GoalDraft::AllOf(ids.iter().cloned().map(Some).collect()));
        let landmarks = Some(ids.into_iter().map(|id| vec![id]).collect());
        let lower_bound = Some(Cost::new(u64::from(count)));
        let clock = Looks::ending_after(1_000_000);
        let stated = Statement { lower_bound, landmarks, relocations: Some(Vec::new()), ..Statement::default() };
        let report = Checker::new(&scene).check(&stated, &clock.budget());
        assert_eq!(report.proven_bound, Cost::new(u64::from(count)));
        clock.seen()
    }

    #[test]
    fn what_is_wanted_away_is_a_landmark_without_chaining() {
        let (few, many) = (looks(50), looks(200));
        assert!(many < 6 * few, "{few} {many}");
    }
}
