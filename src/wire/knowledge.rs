//! Shadows and options as JSON.

use core::iter;

use serde::Serialize;
use utoipa::ToSchema;

use singulate_planner::geometry::{Arc, Shadow};
use singulate_planner::knowledge::{KnownGrasp, ObjectKnowledge};
use singulate_planner::paper::PolarHistogram;
use singulate_planner::scene::{MIN_FREE_WIDTH, ObjectIndex, Scene};

/// The shadows and options of every object.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
pub struct KnowledgeBody {
    /// Every object, in the order of the request.
    #[schema(example = json!([{
        "id": "plate-1", "options": [["plate-2"]], "option_yaws": [[[0.31, 0.55]]],
        "shadows": [{"obstacle": "plate-2", "intervals": [[0.0, 0.42]]}], "histogram": null
    }]))]
    pub objects: Vec<KnownObject>,
}

/// The shadows and options of one object.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
pub struct KnownObject {
    /// The object's id.
    #[schema(example = "plate-1")]
    pub id: String,
    /// The object's options, each a set of ids. Once all objects of one option are gone, this object can be grasped. An
    /// empty option means that it can be grasped now. An object without options can never be moved.
    #[schema(example = json!([["plate-2"], ["plate-5", "plate-7"]]))]
    pub options: Vec<Vec<String>>,
    /// The yaws that each option frees: intervals within [0, 2π/k], rad. An interval across 0 is given as two. Empty for an object
    /// with listed grasps.
    #[schema(example = json!([[[0.31, 0.55]], [[1.7, 1.71]]]))]
    pub option_yaws: Vec<Vec<[f64; 2]>>,
    /// The obstacles that block this object at some yaw. Empty for an object with listed grasps.
    #[schema(example = json!([{"obstacle": "plate-2", "intervals": [[0.0, 0.42], [1.9, 2.0943951]]}]))]
    pub shadows: Vec<ShadowBody>,
    /// Only there for an object with listed grasps, or with those that go with its shape: the ones that the hand can do.
    #[schema(value_type = Vec<KnownGraspBody>, required = false,
        example = json!([{"x": 0.4, "y": 0.2, "yaw": 1.8708, "blockers": ["plate-2"]}]))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub grasps: Option<Vec<KnownGraspBody>>,
    /// The paper's polar histogram. Null unless `grasp_model` is `sector`.
    #[schema(required = true)]
    pub histogram: Option<HistogramBody>,
}

/// The yaws that one obstacle blocks.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
pub struct ShadowBody {
    /// The obstacle's id.
    #[schema(example = "plate-2")]
    pub obstacle: String,
    /// The blocked yaws: intervals within [0, 2π/k], rad. An interval across 0 is given as two.
    #[schema(example = json!([[0.0, 0.42], [1.9, 2.0943951]]))]
    pub intervals: Vec<[f64; 2]>,
}

/// One grasp of an object as it stands.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
pub struct KnownGraspBody {
    /// The gripper's axis along the table's x, m.
    #[schema(example = 0.4)]
    pub x: f64,
    /// The gripper's axis along the table's y, m.
    #[schema(example = 0.2)]
    pub y: f64,
    /// The direction of finger 0, rad, counter-clockwise from +x, in [0, 2π).
    #[schema(example = 1.8708)]
    pub yaw: f64,
    /// The ids of the obstacles that block it. It is free once all of them are gone.
    #[schema(example = json!(["plate-2"]))]
    pub blockers: Vec<String>,
}

/// The paper's polar histogram round an object, in sectors of one degree. Magnitudes have no unit: at least 1 where
/// there is an obstacle, larger where it is nearer. They follow Eq. 1 with b = 1 in cells of 5 mm. Eq. 8 gives each
/// object an a of its own, so magnitudes of two objects can't be compared.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
pub struct HistogramBody {
    /// H(z) of Eq. 1, summed over the obstacles, for z = 0 … 359 degrees.
    #[schema(max_items = 360, example = json!([0.0, 441.0, 441.0, 0.0]))]
    pub h: Vec<f64>,
    /// G(z) of Eq. 2 and 11 for z = 0, 1, … below 360/k degrees: zero where nothing blocks.
    #[schema(max_items = 180, example = json!([0.0, 441.0, 882.0, 0.0]))]
    pub g: Vec<f64>,
}

impl KnowledgeBody {
    /// The knowledge of a scene's objects, with the paper's histograms of them, if there are any.
    pub fn new(scene: &Scene, known: &[ObjectKnowledge], histograms: &[Option<PolarHistogram>]) -> Self {
        let histograms = histograms.iter().map(Option::as_ref).chain(iter::repeat(None));
        let objects = known.iter().zip(histograms);
        Self { objects: objects.map(|(known, histogram)| KnownObject::new(scene, known, histogram)).collect() }
    }
}

impl KnownObject {
    fn new(scene: &Scene, known: &ObjectKnowledge, histogram: Option<&PolarHistogram>) -> Self {
        let id = |object: &ObjectIndex| scene.object(*object).id().to_owned();
        let listed = known.grasps.is_some();
        let yaws = |shadow: &Shadow| shadow.yaws().map(|yaws| intervals(yaws.arcs()));
        let shadows = known.shadows.iter().filter_map(|blocker| {
            Some(ShadowBody { obstacle: id(&blocker.object), intervals: yaws(&blocker.shadow)? })
        });
        let option_yaws = known.options.iter().filter(|_| !listed).map(|option| intervals(&option.free));
        let grasp = |KnownGrasp { grasp, blockers }: &KnownGrasp| {
            let blockers = blockers.iter().map(id).collect();
            KnownGraspBody { x: grasp.axis.x, y: grasp.axis.y, yaw: grasp.yaw, blockers }
        };
        Self {
            id: id(&known.object),
            options: known.options.iter().map(|option| option.members.iter().map(id).collect()).collect(),
            option_yaws: option_yaws.collect(),
            shadows: shadows.collect(),
            grasps: known.grasps.as_ref().map(|grasps| grasps.iter().map(grasp).collect()),
            histogram: histogram.map(HistogramBody::new),
        }
    }
}

impl HistogramBody {
    fn new(histogram: &PolarHistogram) -> Self {
        // To a thousandth: more digits mean nothing, and there are up to 540 figures per object.
        let short = |values: Vec<f64>| values.into_iter().map(|value| (value * 1e3).round() / 1e3).collect();
        Self { h: short(histogram.h()), g: short(histogram.g()) }
    }
}

/// Arcs as intervals. An arc cut at 0 may leave a piece that is only rounding: it is dropped.
fn intervals(arcs: &[Arc]) -> Vec<[f64; 2]> {
    arcs.iter().filter(|arc| arc.hi - arc.lo >= MIN_FREE_WIDTH).map(|arc| [arc.lo, arc.hi]).collect()
}
