//! The JSON schema of a stated answer.

use utoipa::openapi::schema::AdditionalProperties;
use utoipa::openapi::{ObjectBuilder, RefOr, Schema, Type};
use utoipa::{PartialSchema, ToSchema};

use super::answer::{ActionWord, VerdictWord};
use super::scene::SceneBody;

/// A scene and a stated answer.
#[derive(Debug, Clone, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct VerifyBody {
    /// The scene, as in a planning request.
    pub scene: SceneBody,
    /// The answer, whole as it was served, or just its `relocations` and `target_grasp`.
    pub plan: PlanBody,
}

/// A stated answer. What is absent or null is not checked.
#[derive(Debug, Clone, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct PlanBody {
    /// The verdict. Where it is absent, `target_grasp` is required.
    pub verdict: Option<VerdictWord>,
    /// Not checked.
    #[schema(example = "cell-4/17")]
    pub scene_id: Option<String>,
    /// The scene's own target.
    #[schema(example = "plate-1")]
    pub target: Option<String>,
    /// The steps, in order.
    #[schema(example = json!([{
        "action": "pick_place", "object": "plate-2", "from": {"x": 0.4, "y": 0.2}, "to": {"x": 1.1, "y": 0.6},
        "grasp": {"yaw": 0.31, "slack": 0.12}, "release": {"yaw": 1.02, "slack": 0.5}, "gap": 0.031
    }]))]
    pub relocations: Vec<StatedRelocation>,
    /// How the target is grasped in the end.
    pub target_grasp: Option<StatedGrasp>,
    /// The count of relocations.
    #[schema(minimum = 0, maximum = 1000000000, example = 1)]
    pub cost: Option<u32>,
    /// No plan is said to have fewer relocations.
    #[schema(minimum = 0, maximum = 1000000000, example = 1)]
    pub lower_bound: Option<u32>,
    /// The plan is said to be as short as any.
    #[schema(example = true)]
    pub optimal: Option<bool>,
    /// The proof of the bound: of each set of ids every plan is said to move at least one.
    #[schema(example = json!([["plate-2", "plate-5"]]))]
    pub landmarks: Option<Vec<Vec<String>>>,
    /// The proof of a deadlock.
    pub deadlock: Option<StatedDeadlock>,
    /// The ids of the best known derivation where there is no plan, in order.
    #[schema(example = json!(["plate-2"]))]
    pub needed: Option<Vec<String>>,
    /// Not checked.
    #[schema(value_type = Option<Vec<AnyObject>>, example = json!([]))]
    pub warnings: (),
    /// Not checked.
    pub statistics: Option<AnyObject>,
}

/// An object whose fields are not described. The schema says so: without a word, some generators admit none.
#[derive(Debug, Clone, Copy)]
pub struct AnyObject(());

impl PartialSchema for AnyObject {
    fn schema() -> RefOr<Schema> {
        let any_field = AdditionalProperties::FreeForm(true);
        let object = ObjectBuilder::new().schema_type(Type::Object).additional_properties(Some(any_field));
        object.description(Some("An object with any fields.")).into()
    }
}

impl ToSchema for AnyObject {}

/// A stated step.
#[derive(Debug, Clone, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct StatedRelocation {
    /// The kind of step; `pick_place` where absent.
    pub action: Option<ActionWord>,
    /// The id of the object that is moved.
    #[schema(example = "plate-2")]
    pub object: String,
    /// Its centre before.
    pub from: Option<StatedPoint>,
    /// Its centre after.
    pub to: StatedPoint,
    /// How it is picked.
    pub grasp: StatedGrasp,
    /// How it is let go.
    pub release: StatedGrasp,
    /// Least distance to another object at the new place, edge to edge, m.
    #[schema(example = 0.031)]
    pub gap: Option<f64>,
}

/// A stated point.
#[derive(Debug, Clone, Copy, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct StatedPoint {
    /// Along the table's x, m.
    #[schema(minimum = -100000, maximum = 100000, example = 0.4)]
    pub x: f64,
    /// Along the table's y, m.
    #[schema(minimum = -100000, maximum = 100000, example = 0.2)]
    pub y: f64,
}

/// A stated yaw.
#[derive(Debug, Clone, Copy, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct StatedGrasp {
    /// Direction of finger 0, rad, counter-clockwise from +x.
    #[schema(example = 0.31)]
    pub yaw: f64,
    /// The free angle on each side of the yaw, rad.
    #[schema(example = 0.12)]
    pub slack: Option<f64>,
}

/// A stated lock.
#[derive(Debug, Clone, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct StatedDeadlock {
    /// The ids of the greatest lock.
    #[schema(example = json!(["plate-1", "plate-2", "vase"]))]
    pub blocked: Vec<String>,
    /// The ids of a least lock within it.
    #[schema(example = json!(["plate-1", "vase"]))]
    pub core: Vec<String>,
}
