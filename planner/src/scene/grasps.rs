//! The grasps of an object: at every yaw for a disc, else a list in the object's own frame, stated or by default.

use core::f64::consts::{FRAC_PI_2, PI, TAU};
use std::sync::{Arc, OnceLock};

use nalgebra::Vector2;
use smallvec::SmallVec;

use super::closing::ClosingFinger;
use super::convex::{Core, length};
use super::fault::{Findings, Place};
use super::flaw::Flaw;
use super::gripper::{Gripper, Opening};
use super::limits::{GRASP_OFFSET_RANGE, MAX_GRASPS, YAW_RANGE};
use super::shape::Shape;
use super::shape_draft::ShapeDraft;

/// How an object may be grasped.
#[derive(Debug, Clone, PartialEq)]
pub enum Grasps {
    /// With the gripper's axis over the origin of the object's frame, at every yaw. Only for discs.
    EveryYaw,
    /// In these ways only, at most [`MAX_GRASPS`]; no two differ by a multiple of 2π/k at one point.
    Listed(Arc<[ListedGrasp]>),
}

/// One way to grasp an object, in the object's own frame.
#[derive(Debug, Clone)]
pub struct ListedGrasp {
    at: Vector2<f64>,
    yaw: f64,
    tolerance: f64,
    shape: Shape,
    gripper: Gripper,
    /// Found when it is first asked for: most objects of a table stand in nobody's way.
    closing: OnceLock<Closing>,
}

/// Two are equal whether or not anybody asked where the fingers close.
impl PartialEq for ListedGrasp {
    fn eq(&self, other: &Self) -> bool {
        let stated = |grasp: &Self| (grasp.at, grasp.yaw, grasp.tolerance);
        stated(self) == stated(other) && self.shape == other.shape && self.gripper == other.gripper
    }
}

/// Where the fingers stand before and after they close.
#[derive(Debug, Clone)]
struct Closing {
    inner: SmallVec<[f64; 4]>,
    /// How far out a closed finger stands at some yaw of the band, m.
    widest: f64,
}

/// An unchecked listed grasp.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct GraspDraft {
    /// The gripper's axis, m. Default: 0.
    pub x: Option<f64>,
    /// The gripper's axis, m. Default: 0.
    pub y: Option<f64>,
    /// The direction of finger 0, rad.
    pub yaw: Option<f64>,
    /// rad. Default: [`DEFAULT_TOLERANCE`].
    pub tolerance: Option<f64>,
}

/// How far the real yaw of a listed grasp may be off where nothing is stated, rad.
pub const DEFAULT_TOLERANCE: f64 = 0.05;

/// Two edges count as parallel up to this angle, rad: 5°.
const PARALLEL: f64 = PI / 36.0;
/// How much wider than the hand opens an object may be, m: rounding, where it is as wide in decimals.
const ROUNDING: f64 = 1e-10;
/// Two grasps nearer than this are one, m and rad.
const SAME: f64 = 1e-9;

impl ListedGrasp {
    fn new(shape: &Shape, gripper: &Gripper, at: Vector2<f64>, yaw: f64, tolerance: f64) -> Self {
        Self { at, yaw, tolerance, shape: shape.clone(), gripper: *gripper, closing: OnceLock::new() }
    }

    /// Warns of an axis beside the object, which is seldom meant, and of degrees.
    fn doubts(&self, (at, n): (usize, usize), id: &str, warnings: &mut Findings) {
        let away = self.shape.core().map_or(self.offset(), |core| core.distance_to_point(self.at));
        if away > self.shape.radius() + ROUNDING {
            warnings.add(Place::Grasp(at, n, "x"), Flaw::AxisBesideObject(id.to_owned()));
        }
        if self.yaw.abs() > TAU {
            warnings.add(Place::Grasp(at, n, "yaw"), Flaw::ManyTurns(self.yaw));
        }
    }

    fn work(&self) -> usize {
        let corners = self.shape.core().map_or(1, |core| core.vertices().len());
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a band is at most π")]
        let turns = 3 + (30.0 * self.band() / PI) as usize * corners;
        self.gripper.fingers as usize * corners * turns
    }

    fn closing(&self) -> &Closing {
        self.closing.get_or_init(|| {
            let (gripper, half) = (&self.gripper, self.gripper.finger_width / 2.0);
            let stops = (0..gripper.fingers).map(|finger| {
                let yaw = self.yaw + f64::from(finger) * gripper.period();
                ClosingFinger::new(&self.shape, self.at, yaw, half).stops(self.band())
            });
            let stops: SmallVec<[[f64; 2]; 4]> = stops.collect();
            let widest = stops.iter().map(|stop| stop[1]).fold(0.0, f64::max);
            Closing { inner: stops.iter().map(|stop| stop[0]).collect(), widest }
        })
    }

    /// The gripper's axis, m.
    pub fn at(&self) -> Vector2<f64> {
        self.at
    }

    /// The direction of finger 0, rad.
    pub fn yaw(&self) -> f64 {
        self.yaw
    }

    /// How far the real yaw may be off, as stated, rad.
    pub fn tolerance(&self) -> f64 {
        self.tolerance
    }

    /// How far the real yaw may be off: the grasp's tolerance or the gripper's, rad. All of this band must be free.
    pub fn band(&self) -> f64 {
        self.tolerance.max(self.gripper.yaw_tolerance)
    }

    /// Per finger how near to the axis it closes at some yaw of the band, m.
    pub fn inner(&self) -> &[f64] {
        &self.closing().inner
    }

    /// R, how far the open fingers reach from the axis, m.
    pub fn outer(&self) -> f64 {
        let open = match (self.gripper.opening, self.gripper.max_opening) {
            (Opening::Full, Some(opening)) => opening / 2.0,
            _ => self.closing().widest,
        };
        open + self.gripper.clearance
    }

    /// From the axis to the open fingers' outer corners, m.
    pub fn corner_distance(&self) -> f64 {
        self.gripper.corner(self.outer())
    }

    /// No corner of the open fingers is farther from the origin of the object's frame than this, m. A bound that needs no closed
    /// fingers.
    pub fn reach(&self) -> f64 {
        let open = match (self.gripper.opening, self.gripper.max_opening) {
            (Opening::Full, Some(opening)) => opening / 2.0,
            _ => self.offset() + self.shape.circumradius(),
        };
        self.gripper.corner(open + self.gripper.clearance) + self.offset()
    }

    /// From the origin of the object's frame to the axis, m.
    pub fn offset(&self) -> f64 {
        length(self.at)
    }

    /// True if the object is not too wide for the hand in this way.
    pub fn fits(&self) -> bool {
        self.gripper.max_opening.is_none_or(|opening| self.closing().widest <= opening / 2.0 + ROUNDING)
    }

    /// The width of the object in this way, m: twice the farthest that a closed finger stands from the axis.
    fn width(&self) -> f64 {
        2.0 * self.closing().widest
    }

    fn is(&self, other: &Self, gripper: &Gripper) -> bool {
        let apart = (self.at - other.at).abs();
        let turn = (self.yaw - other.yaw) / gripper.period();
        apart.max() <= SAME && (turn - turn.round()).abs() * gripper.period() <= SAME
    }
}

impl Grasps {
    /// The list; `None` for a grasp at every yaw.
    pub fn listed(&self) -> Option<&[ListedGrasp]> {
        match self {
            Self::EveryYaw => None,
            Self::Listed(list) => Some(list),
        }
    }

    /// The grasps of the object at a position: those of the draft, else those that go with its shape.
    pub(super) fn new(
        (at, id): (usize, &str),
        (draft, shape): (&ShapeDraft, &Shape),
        stated: Option<&[GraspDraft]>,
        gripper: &Gripper,
        (faults, warnings): (&mut Findings, &mut Findings),
    ) -> Option<Self> {
        let list = match stated {
            Some(stated) if stated.len() > MAX_GRASPS => {
                faults.add(Place::Object(at, "grasps"), Flaw::TooManyGrasps { count: stated.len(), max: MAX_GRASPS });
                return None;
            }
            Some(stated) => {
                let checked =
                    stated.iter().enumerate().map(|(n, draft)| checked((at, n), draft, shape, gripper, faults));
                let list = checked.collect::<Vec<_>>().into_iter().collect::<Option<Vec<_>>>()?;
                (0..).zip(&list).for_each(|(n, grasp): (usize, &ListedGrasp)| grasp.doubts((at, n), id, warnings));
                list
            }
            None if draft.is_disc() => return Some(Self::EveryYaw),
            None => by_default(draft, shape, gripper),
        };
        let mut kept: Vec<ListedGrasp> = Vec::with_capacity(list.len());
        for grasp in list {
            if !kept.iter().any(|other| other.is(&grasp, gripper)) {
                kept.push(grasp);
            }
        }
        if kept.len() > MAX_GRASPS {
            faults.add(Place::WholeObject(at), Flaw::TooManyGrasps { count: kept.len(), max: MAX_GRASPS });
            return None;
        }
        Some(Self::Listed(kept.into()))
    }

    /// What it takes at most to find out where the fingers close, in turns of a finger times corners of the object.
    pub(super) fn work(&self) -> usize {
        self.listed().into_iter().flatten().map(ListedGrasp::work).sum()
    }

    /// The width of the object in its narrowest way, m; `None` without any.
    pub(super) fn least_width(&self) -> Option<f64> {
        self.listed()?.iter().map(ListedGrasp::width).reduce(f64::min)
    }
}

fn checked(
    (at, n): (usize, usize),
    draft: &GraspDraft,
    shape: &Shape,
    gripper: &Gripper,
    faults: &mut Findings,
) -> Option<ListedGrasp> {
    let mut ranged = |value: Option<f64>, (min, max): (f64, f64), name| {
        let value = value?;
        let sound = (min..=max).contains(&value);
        if !sound {
            faults.add(Place::Grasp(at, n, name), Flaw::OutOfRange { value, min, max });
        }
        sound.then_some(value)
    };
    let x = ranged(draft.x.or(Some(0.0)), GRASP_OFFSET_RANGE, "x");
    let y = ranged(draft.y.or(Some(0.0)), GRASP_OFFSET_RANGE, "y");
    let yaw = ranged(draft.yaw, YAW_RANGE, "yaw");
    let tolerance = ranged(draft.tolerance.or(Some(DEFAULT_TOLERANCE)), (0.0, gripper.period() / 2.0), "tolerance");
    if tolerance.is_some_and(|tolerance| tolerance >= gripper.period() / 2.0) {
        faults.add(Place::Grasp(at, n, "tolerance"), Flaw::WideTolerance { fingers: gripper.fingers });
        return None;
    }
    Some(ListedGrasp::new(shape, gripper, Vector2::new(x?, y?), yaw?, tolerance?))
}

/// The grasps that go with a shape: for two jaws across each pair of parallel edges and across the middle of a capsule, for four
/// fingers along the axes of a rectangle, else none.
fn by_default(draft: &ShapeDraft, shape: &Shape, gripper: &Gripper) -> Vec<ListedGrasp> {
    let centred = |yaws: &[f64]| yaws.iter().map(|&yaw| (Vector2::zeros(), yaw)).collect();
    let ways: Vec<(Vector2<f64>, f64)> = match (draft, gripper.fingers) {
        (ShapeDraft::Rectangle { .. }, 2) => centred(&[FRAC_PI_2, 0.0]),
        (ShapeDraft::Rectangle { .. }, 4) => centred(&[0.0]),
        (ShapeDraft::Capsule { .. }, 2) => centred(&[FRAC_PI_2]),
        (ShapeDraft::Polygon { .. }, 2) => shape.core().map(across_parallel_edges).unwrap_or_default(),
        _ => Vec::new(),
    };
    let tolerance = DEFAULT_TOLERANCE.min(gripper.period() / 4.0);
    ways.into_iter().map(|(at, yaw)| ListedGrasp::new(shape, gripper, at, yaw, tolerance)).collect()
}

/// Over the centroid, square to the bisector of each pair of parallel edges.
fn across_parallel_edges(core: &Core) -> Vec<(Vector2<f64>, f64)> {
    let (centroid, axes) = (core.centroid(), core.axes());
    let mut ways = Vec::new();
    for (at, a) in axes.iter().enumerate() {
        for b in &axes[at + 1..] {
            let turn = libm::atan2(a.normal.perp(&-b.normal), a.normal.dot(&-b.normal));
            if turn.abs() <= PARALLEL + SAME {
                let square = a.normal - b.normal;
                ways.push((centroid, libm::atan2(square.y, square.x)));
            }
        }
    }
    ways
}
