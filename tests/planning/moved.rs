//! The same table turned, mirrored or shifted: the same logical verdict and the same bound.

use core::f64::consts::FRAC_PI_2;

use singulate::experiments::{mixed, varied};
use singulate_planner::budget::Budget;
use singulate_planner::plan::{Settings, plan};
use singulate_planner::scene::{GraspDraft, ObjectDraft, RectangleDraft, Scene, SceneDraft, SceneLimits, ShapeDraft};
use singulate_planner::search::SILENT;
use singulate_planner::statement::Verdict;

use crate::generated::count;

/// How a table is moved: of a point, of a yaw; and whether shapes are mirrored.
struct Move {
    point: fn(f64, f64) -> (f64, f64),
    yaw: fn(f64) -> f64,
    mirrored: bool,
}

const MOVES: [(&str, Move); 3] = [
    ("turned", Move { point: |x, y| (-y, x), yaw: |yaw| yaw + FRAC_PI_2, mirrored: false }),
    ("mirrored", Move { point: |x, y| (x, -y), yaw: |yaw| -yaw, mirrored: true }),
    ("shifted", Move { point: |x, y| (x + 3.25, y - 1.5), yaw: |yaw| yaw, mirrored: false }),
];

impl Move {
    fn scene(&self, draft: &SceneDraft) -> SceneDraft {
        let mut moved = draft.clone();
        moved.table.top = self.rectangle(draft.table.top);
        moved.table.keep_out = draft.table.keep_out.iter().map(|area| self.rectangle(*area)).collect();
        moved.objects = draft.objects.iter().map(|object| self.object(object)).collect();
        moved
    }

    fn rectangle(&self, area: RectangleDraft) -> RectangleDraft {
        let corner = |x: Option<f64>, y: Option<f64>| (self.point)(x.unwrap(), y.unwrap());
        let ((ax, ay), (bx, by)) = (corner(area.x_min, area.y_min), corner(area.x_max, area.y_max));
        RectangleDraft {
            x_min: Some(ax.min(bx)),
            y_min: Some(ay.min(by)),
            x_max: Some(ax.max(bx)),
            y_max: Some(ay.max(by)),
        }
    }

    fn object(&self, object: &ObjectDraft) -> ObjectDraft {
        let (x, y) = (self.point)(object.x.unwrap(), object.y.unwrap());
        let mut moved = ObjectDraft { x: Some(x), y: Some(y), ..object.clone() };
        moved.yaw = Some((self.yaw)(object.yaw.unwrap_or_default()));
        if self.mirrored {
            if let ShapeDraft::Polygon { points, .. } = &mut moved.shape {
                points.iter_mut().for_each(|[_, y]| *y = y.map(|y| -y));
            }
            for GraspDraft { y, yaw, .. } in moved.grasps.iter_mut().flatten() {
                (*y, *yaw) = (y.map(|y| -y), yaw.map(|yaw| -yaw));
            }
        }
        moved
    }
}

/// What does not depend on where the table stands: the verdict, and the bound, or what a clearing is proven to leave.
fn logical(draft: SceneDraft) -> Option<(&'static str, Option<u64>)> {
    let (scene, _) = Scene::new(draft, &SceneLimits::default()).ok()?;
    let stated = plan(&scene, &Settings::default(), &Budget::unlimited(), SILENT).unwrap().statement;
    let verdict = match stated.verdict.unwrap() {
        Verdict::NoSpace => Verdict::Relocate,
        verdict => verdict,
    };
    let left = stated.left.filter(|_| stated.proven == Some(true)).map(|left| left.len() as u64);
    Some((verdict.as_str(), stated.lower_bound.map(|bound| bound.get()).or(left)))
}

#[test]
fn where_the_table_stands_changes_neither_verdict_nor_bound() {
    let (mut compared, mut relocated) = (0, 0);
    let seeds = count("GENERATED_SHAPES", 150);
    for seed in 0..seeds {
        let draft = mixed(&varied(seed), seed);
        let Some(stands) = logical(draft.clone()) else { continue };
        relocated += usize::from(stands.0 == "relocate");
        for (name, way) in &MOVES {
            let moved = logical(way.scene(&draft)).expect("a sound scene stays sound");
            let unproven = stands.0 == "partly_cleared" && (stands.1.is_none() || moved.1.is_none());
            assert!(moved == stands || unproven && moved.0 == stands.0, "{seed} {name}: {stands:?} {moved:?}");
            compared += 1;
        }
    }
    assert!(compared * 2 > seeds * 5 && relocated > 10, "{compared} {relocated}");
}
