//! Knowledge of each object before any search: its shadows and options.

use super::base::KnowledgeBase;
use super::grasp_model::{GraspModel, blockers};
use super::options::{Blocker, blocking};
use super::scene_base::{NoBase, complete};
use crate::budget::{Budget, Interrupted};
use crate::geometry::{Arc, ArcSet, Grasp, Shadow, listed};
use crate::scene::{Grasps, ObjectIndex, Scene};

/// An option with the yaws that it frees.
#[derive(Debug, Clone, PartialEq)]
pub struct KnownOption {
    /// All of these must be moved, in index order; empty if the object is graspable now.
    pub members: Vec<ObjectIndex>,
    /// The yaws that are free after that, rad, as arcs within [0, 2π/k]; one that runs over 0 is two. None for an object with
    /// listed grasps.
    pub free: Vec<Arc>,
}

/// A listed grasp of an object as it stands.
#[derive(Debug, Clone, PartialEq)]
pub struct KnownGrasp {
    /// The grasp.
    pub grasp: Grasp,
    /// The obstacles that block it, in index order.
    pub blockers: Vec<ObjectIndex>,
}

/// The knowledge of one object.
#[derive(Debug, Clone, PartialEq)]
pub struct ObjectKnowledge {
    /// The object.
    pub object: ObjectIndex,
    /// Its options, none with an object that no plan moves; empty for one that can't be grasped.
    pub options: Vec<KnownOption>,
    /// The obstacles that block some grasp; none for an object that can't be grasped.
    pub shadows: Vec<Blocker>,
    /// The listed grasps that the hand can do; `None` for an object that may be grasped at every yaw.
    pub grasps: Option<Vec<KnownGrasp>>,
}

/// The knowledge of every object, in index order.
///
/// # Errors
/// [`NoBase`] when the budget ends, or if the objects are too dense.
pub fn known(scene: &Scene, model: &dyn GraspModel, budget: &Budget<'_>) -> Result<Vec<ObjectKnowledge>, NoBase> {
    let scene = &scene.without_goal();
    let base = complete(scene, model, budget)?;
    let each = scene.indices().map(|object| {
        budget.check()?;
        Ok(of_object(scene, &base, model, object, budget)?)
    });
    each.collect()
}

fn of_object(
    scene: &Scene,
    base: &KnowledgeBase,
    model: &dyn GraspModel,
    object: ObjectIndex,
    budget: &Budget<'_>,
) -> Result<ObjectKnowledge, Interrupted> {
    if !scene.object(object).can_be_grasped() {
        let grasps = scene.object(object).grasps().listed().map(|_| Vec::new());
        return Ok(ObjectKnowledge { object, options: Vec::new(), shadows: Vec::new(), grasps });
    }
    let shadows = blockers(scene, object, model, budget)?;
    let movable = |option: &&[ObjectIndex]| option.iter().all(|&member| scene.movable(member));
    // What no drop-off accepts has no rules by which it is moved, and yet it can be grasped.
    let own = match scene.movable(object) {
        true => None,
        false => Some(KnowledgeBase::from_iter([model.options(scene, object, budget)?])),
    };
    let (base, row) = own.as_ref().map_or((base, object), |own| (own, ObjectIndex::new(0)));
    let options = base
        .options(row)
        .filter(movable)
        .map(|option| KnownOption { members: option.to_vec(), free: free_without(scene, object, &shadows, option) });
    let (options, grasps) = (options.collect(), grasps(scene, object, &shadows));
    Ok(ObjectKnowledge { object, options, shadows, grasps })
}

fn grasps(scene: &Scene, object: ObjectIndex, shadows: &[Blocker]) -> Option<Vec<KnownGrasp>> {
    let Grasps::Listed(list) = scene.object(object).grasps() else { return None };
    let ways = list.iter().zip(0_u32..).filter(|(grasp, _)| grasp.fits());
    let known =
        |(grasp, way)| KnownGrasp { grasp: listed(scene.placed(object), grasp), blockers: blocking(shadows, way) };
    Some(ways.map(known).collect())
}

/// The free yaws once the objects `gone` are removed, in intervals wide enough to count.
fn free_without(scene: &Scene, object: ObjectIndex, shadows: &[Blocker], gone: &[ObjectIndex]) -> Vec<Arc> {
    if scene.object(object).grasps().listed().is_some() {
        return Vec::new();
    }
    let gripper = scene.gripper();
    let left = shadows.iter().filter(|blocker| !gone.contains(&blocker.object)).map(|blocker| &blocker.shadow);
    let blocked = ArcSet::union(gripper.period(), left.filter_map(Shadow::yaws));
    let counting = blocked.free().filter(|gap| gap.width >= gripper.min_free_width());
    let ends: Vec<(f64, f64)> = counting.map(|gap| (gap.start, gap.start + gap.width)).collect();
    ArcSet::fold(gripper.period(), &ends).arcs().to_vec()
}
