//! A planning request read from JSON.

use core::time::Duration;

use super::code::ErrorCode;
use super::finding;
use super::problem::{Problem, WarningItem};
use super::reader::{Faults, Names, Node, Path, parse};
use super::settings::StatedSettings;
use super::typed;
use singulate_planner::paper::DEFAULT_RESOLUTION;
use singulate_planner::plan::Settings;
use singulate_planner::scene::{
    Flaw, GripperDraft, ObjectDraft, RectangleDraft, Scene, SceneDraft, SceneLimits, TableDraft,
};

/// The longest scene id, characters: it stands in every log line of its request.
pub const MAX_SCENE_ID_LENGTH: usize = 256;

/// What a request may ask for at the most.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RequestLimits {
    /// The limits of a scene; its overlap tolerance holds where a request names none.
    pub scene: SceneLimits,
    /// The greatest overlap tolerance that a request may name, m; see also
    /// [`greatest_overlap_tolerance`](Self::greatest_overlap_tolerance).
    pub max_overlap_tolerance: f64,
    /// The time limit of a request that names none.
    pub default_time_limit: Duration,
    /// The longest time limit that a request may name.
    pub max_time_limit: Duration,
    /// The side of a pixel of the images on which `placement: raster` finds places, m.
    pub raster_resolution: f64,
}

impl Default for RequestLimits {
    fn default() -> Self {
        Self {
            scene: SceneLimits::default(),
            // Two centres that are off by 5 mm each. Past that most dishes of a scene would be noise.
            max_overlap_tolerance: 1e-2,
            // A thousand times what most scenes take, and a robot bears to wait so long.
            default_time_limit: Duration::from_millis(1000),
            // The paper's own limit. Whoever has more time has a thread for as long.
            max_time_limit: Duration::from_millis(60_000),
            raster_resolution: DEFAULT_RESOLUTION,
        }
    }
}

impl RequestLimits {
    /// The greatest overlap tolerance that a request may name, m. What holds where it names none, it may always name.
    pub fn greatest_overlap_tolerance(&self) -> f64 {
        self.max_overlap_tolerance.max(self.scene.overlap_tolerance)
    }
}

/// A checked request.
#[derive(Debug, Clone)]
pub struct PlanRequest {
    /// The scene.
    pub scene: Scene,
    /// The caller's name for it.
    pub scene_id: Option<String>,
    /// How to plan.
    pub settings: Settings,
    /// How deep the scene's discs may overlap, m.
    pub overlap_tolerance: f64,
    /// The time for waiting and planning.
    pub time_limit: Duration,
    /// What is worth knowing about the scene.
    pub warnings: Vec<WarningItem>,
}

impl AsRef<PlanRequest> for PlanRequest {
    fn as_ref(&self) -> &PlanRequest {
        self
    }
}

/// Read a planning request.
///
/// # Errors
/// A problem with every fault of the body.
pub fn read_scene(body: &[u8], limits: &RequestLimits) -> Result<PlanRequest, Problem> {
    sound(body, limits).map_or_else(|| walked(body, limits), Ok)
}

/// Read a sound body straight; see [`typed`].
pub(super) fn sound(body: &[u8], limits: &RequestLimits) -> Option<PlanRequest> {
    typed::scene(body, limits)?.sound(&Path::Root, limits)
}

/// Read any body by way of a JSON value.
pub(super) fn walked(body: &[u8], limits: &RequestLimits) -> Result<PlanRequest, Problem> {
    let (value, mut faults) = parse(body)?;
    let request = request(Node::root(&value), &REQUEST, limits, &mut faults);
    faults.judge(request)
}

pub(super) const REQUEST: Names = Names::of(&["scene_id", "table", "gripper", "objects", "target", "settings"]);
const TABLE: Names = Names::of(&["x_min", "y_min", "x_max", "y_max", "keep_out"]);
const RECTANGLE: Names = Names::of(&["x_min", "y_min", "x_max", "y_max"]);
const GRIPPER: Names = Names::of(&["fingers", "finger_width", "clearance", "margin", "yaw_tolerance"]);
// A later version may know objects that are no discs.
const OBJECT: Names = Names { known: &["id", "x", "y", "radius", "fixed"], reserved: &["shape"] };

/// A planning request, whose own fields stand among `names`.
pub(super) fn request(
    node: Node<'_>,
    names: &Names,
    limits: &RequestLimits,
    faults: &mut Faults,
) -> Option<PlanRequest> {
    let fields = node.fields(names, faults)?;
    let scene_id = fields.optional("scene_id", None, faults, scene_id);
    let table = fields.required("table", faults, table);
    let gripper = fields.required("gripper", faults, gripper);
    let objects = fields.required("objects", faults, |node, faults| objects(node, limits, faults));
    let target = fields.required("target", faults, |node, faults| node.text(faults));
    let settings = fields.optional("settings", StatedSettings::absent(limits), faults, |node, faults| {
        Some(StatedSettings::read(node, limits, faults))
    });
    let draft = SceneDraft {
        table: table.unwrap_or_default(),
        gripper: gripper.unwrap_or_default(),
        // Without a list of objects nobody can say that the target is not in it.
        target: target.filter(|_| objects.is_some()),
        objects: objects.unwrap_or_default(),
    };
    let named = scene_id.is_some();
    let stated = StatedRequest { scene_id: scene_id.flatten(), draft, settings: settings? };
    stated.checked(node.path(), limits, faults).filter(|_| named)
}

/// What a request says, its scene unchecked.
pub(super) struct StatedRequest {
    pub(super) scene_id: Option<String>,
    pub(super) draft: SceneDraft,
    pub(super) settings: StatedSettings,
}

impl StatedRequest {
    /// The request that stands at `path`, unless anything is wrong with it.
    pub(super) fn sound(self, path: &Path<'_>, limits: &RequestLimits) -> Option<PlanRequest> {
        let mut faults = Faults::default();
        let request = self.checked(path, limits, &mut faults);
        faults.judge(request).ok()
    }

    fn checked(self, path: &Path<'_>, limits: &RequestLimits, faults: &mut Faults) -> Option<PlanRequest> {
        let Self { scene_id, draft, settings } = self;
        let overlap_tolerance = settings.overlap_tolerance(limits);
        match Scene::new(draft, &SceneLimits { overlap_tolerance, ..limits.scene }) {
            Ok((scene, warnings)) => {
                let warnings = warnings.iter().map(|warning| finding::item(path, warning)).collect();
                let (settings, time_limit) = settings.on(scene.table(), limits, path, faults)?;
                Some(PlanRequest { scene, scene_id, settings, overlap_tolerance, time_limit, warnings })
            }
            Err(findings) => {
                findings.iter().for_each(|fault| finding::note(path, fault, faults));
                None
            }
        }
    }
}

fn scene_id(node: Node<'_>, faults: &mut Faults) -> Option<Option<String>> {
    let text = node.text(faults)?;
    let length = text.chars().count();
    if length > MAX_SCENE_ID_LENGTH {
        let detail = format_args!("a scene id has at most {MAX_SCENE_ID_LENGTH} characters, this one has {length}");
        faults.add(ErrorCode::IdLength, node.path(), detail);
        return None;
    }
    Some(Some(text))
}

fn table(node: Node<'_>, faults: &mut Faults) -> Option<TableDraft> {
    let fields = node.fields(&TABLE, faults)?;
    let top = RectangleDraft {
        x_min: fields.number("x_min", faults),
        y_min: fields.number("y_min", faults),
        x_max: fields.number("x_max", faults),
        y_max: fields.number("y_max", faults),
    };
    let keep_out = fields.optional("keep_out", Vec::new(), faults, |node, faults| node.list(faults, rectangle));
    Some(TableDraft { top, keep_out: keep_out.unwrap_or_default() })
}

fn rectangle(node: Node<'_>, faults: &mut Faults) -> Option<RectangleDraft> {
    let fields = node.fields(&RECTANGLE, faults)?;
    Some(RectangleDraft {
        x_min: fields.number("x_min", faults),
        y_min: fields.number("y_min", faults),
        x_max: fields.number("x_max", faults),
        y_max: fields.number("y_max", faults),
    })
}

fn gripper(node: Node<'_>, faults: &mut Faults) -> Option<GripperDraft> {
    let fields = node.fields(&GRIPPER, faults)?;
    Some(GripperDraft {
        fingers: fields.number("fingers", faults),
        finger_width: fields.number("finger_width", faults),
        clearance: fields.number("clearance", faults),
        margin: fields.optional("margin", 0.0, faults, |node, faults| node.number(faults)),
        yaw_tolerance: fields.optional("yaw_tolerance", 0.0, faults, |node, faults| node.number(faults)),
    })
}

fn objects(node: Node<'_>, limits: &RequestLimits, faults: &mut Faults) -> Option<Vec<ObjectDraft>> {
    let (count, max) = (node.length(), limits.scene.max_objects);
    if count > max {
        // Not worth the work of reading them.
        faults.add(ErrorCode::TooManyObjects, node.path(), format_args!("{}", Flaw::TooManyObjects { count, max }));
        return None;
    }
    node.list(faults, object)
}

fn object(node: Node<'_>, faults: &mut Faults) -> Option<ObjectDraft> {
    let fields = node.fields(&OBJECT, faults)?;
    Some(ObjectDraft {
        id: fields.required("id", faults, |node, faults| node.text(faults)),
        x: fields.number("x", faults),
        y: fields.number("y", faults),
        radius: fields.number("radius", faults),
        fixed: fields.stated("fixed", faults, |node, faults| node.boolean(faults)).unwrap_or_default(),
    })
}
