//! A small builder of scenes and stated answers, and one scene with a plan that is worked out by hand.

use nalgebra::Point2;
use singulate_planner::budget::Budget;
use singulate_planner::check::{Checker, FaultCode, Report};
use singulate_planner::cost::Cost;
use singulate_planner::scene::{
    Destination, DropOffDraft, GoalDraft, GripperDraft, ObjectDraft, Opening, RectangleDraft, Scene, SceneDraft,
    SceneLimits, ShapeDraft,
};
use singulate_planner::statement::{PickPlace, StatedGrasp, Statement, Step, Verdict};

pub(crate) struct Builder(SceneDraft);

fn rectangle([x_min, y_min, x_max, y_max]: [f64; 4]) -> RectangleDraft {
    RectangleDraft { x_min: Some(x_min), y_min: Some(y_min), x_max: Some(x_max), y_max: Some(y_max) }
}

impl Builder {
    /// A table of 2 × 2 m and k fingers, 0.02 m wide, 0.05 m of clearance.
    pub(crate) fn new(fingers: u32) -> Self {
        let mut draft = SceneDraft::default();
        draft.table.top = rectangle([0.0, 0.0, 2.0, 2.0]);
        draft.gripper = GripperDraft {
            fingers: Some(f64::from(fingers)),
            finger_width: Some(0.02),
            clearance: Some(0.05),
            margin: Some(0.0),
            yaw_tolerance: Some(0.0),
            ..GripperDraft::default()
        };
        Self(draft)
    }

    pub(crate) fn table(mut self, sides: [f64; 4]) -> Self {
        self.0.table.top = rectangle(sides);
        self
    }

    pub(crate) fn keep_out(mut self, sides: [f64; 4]) -> Self {
        self.0.table.keep_out.push(rectangle(sides));
        self
    }

    pub(crate) fn margin(mut self, margin: f64) -> Self {
        self.0.gripper.margin = Some(margin);
        self
    }

    pub(crate) fn yaw_tolerance(mut self, tolerance: f64) -> Self {
        self.0.gripper.yaw_tolerance = Some(tolerance);
        self
    }

    pub(crate) fn disc(mut self, id: &str, x: f64, y: f64, radius: f64) -> Self {
        let object = ObjectDraft {
            id: Some(id.into()),
            x: Some(x),
            y: Some(y),
            shape: ShapeDraft::disc(radius),
            ..ObjectDraft::default()
        };
        self.0.objects.push(object);
        self
    }

    /// The object `id` stands somewhere else.
    pub(crate) fn move_to(mut self, id: &str, x: f64, y: f64) -> Self {
        let object = self.0.objects.iter_mut().find(|object| object.id.as_deref() == Some(id));
        let object = object.expect("an object of the scene");
        (object.x, object.y) = (Some(x), Some(y));
        self
    }

    /// Every object stands `off` m farther along both axes.
    pub(crate) fn shift(mut self, off: f64) -> Self {
        for object in &mut self.0.objects {
            (object.x, object.y) = (object.x.map(|x| x + off), object.y.map(|y| y + off));
        }
        self
    }

    /// The object `id` can't be moved.
    pub(crate) fn fix(mut self, id: &str) -> Self {
        let object = self.0.objects.iter_mut().find(|object| object.id.as_deref() == Some(id));
        object.expect("an object of the scene").fixed = true;
        self
    }

    pub(crate) fn drop_off(mut self, id: &str, capacity: Option<u32>, accepts: Option<&[&str]>) -> Self {
        let accepts = accepts.map(|ids| ids.iter().map(|id| Some((*id).to_owned())).collect());
        let drop_off = DropOffDraft { id: Some(id.into()), capacity: capacity.map(f64::from), accepts };
        self.0.drop_offs.get_or_insert_default().push(drop_off);
        self
    }

    pub(crate) fn destination(mut self, destination: Destination) -> Self {
        self.0.destination = Some(destination);
        self
    }

    pub(crate) fn opening(mut self, max_opening: f64, opening: Opening) -> Self {
        self.0.gripper = GripperDraft { max_opening: Some(max_opening), opening: Some(opening), ..self.0.gripper };
        self
    }

    pub(crate) fn build(self, target: &str) -> Scene {
        self.wanting(GoalDraft::Target(target.into()))
    }

    pub(crate) fn wanting(mut self, goal: GoalDraft) -> Scene {
        self.0.goal = Some(goal);
        let limits = SceneLimits { max_objects: 20_000, ..SceneLimits::default() };
        Scene::new(self.0, &limits).expect("a scene that holds").0
    }
}

pub(crate) fn grasp(yaw: f64, slack: f64) -> StatedGrasp {
    StatedGrasp { at: None, yaw, slack: Some(slack) }
}

/// A step that states nothing it need not.
pub(crate) fn step(object: &str, to: [f64; 2], grasp_yaw: f64, release_yaw: f64) -> Step {
    Step::PickPlace(pick_place(object, to, grasp_yaw, release_yaw))
}

fn pick_place(object: &str, to: [f64; 2], grasp_yaw: f64, release_yaw: f64) -> PickPlace {
    PickPlace {
        object: object.into(),
        from: None,
        to: Point2::new(to[0], to[1]).into(),
        grasp: StatedGrasp { at: None, yaw: grasp_yaw, slack: None },
        release: StatedGrasp { at: None, yaw: release_yaw, slack: None },
        turn: None,
        gap: None,
    }
}

/// One step of a plan, to make something of it wrong.
pub(crate) fn step_mut(stated: &mut Statement, at: usize) -> &mut PickPlace {
    stated.relocations.as_mut().expect("a plan with steps")[at].pick_place_mut().expect("a pick-and-place")
}

pub(crate) fn ids(names: &[&str]) -> Vec<String> {
    names.iter().map(|name| (*name).to_owned()).collect()
}

/// What the checker says, the first time and, with all that it has learnt by then, the second.
pub(crate) fn judge(scene: &Scene, stated: &Statement) -> Report {
    let mut checker = Checker::new(scene);
    let report = checker.check(stated, &Budget::unlimited());
    assert_eq!(checker.check(stated, &Budget::unlimited()), report);
    report
}

/// The kinds of fault found, each once, in the order in which they came.
pub(crate) fn codes(report: &Report) -> Vec<FaultCode> {
    let mut codes: Vec<FaultCode> = Vec::new();
    for fault in &report.faults {
        if !codes.contains(&fault.code) {
            codes.push(fault.code);
        }
    }
    codes
}

#[track_caller]
pub(crate) fn assert_valid(scene: &Scene, stated: &Statement) {
    let report = judge(scene, stated);
    assert!(report.faults.is_empty() && !report.interrupted, "{:#?}", report.faults);
}

/// Two fingers and a target between two posts, `north` and `south`, so that its yaw must be within 46° of the x axis;
/// there stand `west` and `east`, each in the way of 48° on either side. `west` can only be lifted along the y axis, where
/// `cap` stands; `cap` is free between 27° and 46°. `far` has nothing to do with it.
pub(crate) fn gate() -> Builder {
    Builder::new(2)
        .keep_out([0.0, 1.5, 0.24, 1.9])
        .disc("target", 1.0, 1.0, 0.05)
        .disc("north", 1.0, 1.145, 0.09)
        .disc("south", 1.0, 0.855, 0.09)
        .disc("west", 0.838, 1.0, 0.11)
        .disc("east", 1.162, 1.0, 0.11)
        .disc("cap", 0.838, 1.172, 0.06)
        .disc("far", 1.7, 1.7, 0.05)
}

pub(crate) fn gate_with_posts() -> Scene {
    gate().fix("north").fix("south").build("target")
}

/// The only three objects that need to go. `cap` ends in touch with the keep-out, `west` in touch with `far`, `east` in
/// touch with the table's edge.
pub(crate) fn gate_plan() -> Statement {
    let full = |object: &str, from: [f64; 2], to: [f64; 2], pick: StatedGrasp, gap: f64| {
        Step::PickPlace(PickPlace {
            from: Some(Point2::new(from[0], from[1]).into()),
            grasp: pick,
            release: grasp(1.5, 0.1),
            gap: Some(gap),
            ..pick_place(object, to, 0.0, 0.0)
        })
    };
    // From the cap's new place the nearest disc is west; from east's it is south.
    let apart = |x: f64, y: f64, radii: f64| (x * x + y * y).sqrt() - radii;
    Statement {
        verdict: Some(Verdict::Relocate),
        relocations: Some(vec![
            full("cap", [0.838, 1.172], [0.3, 1.6], grasp(0.637, 0.1), apart(0.538, 0.6, 0.17)),
            full("west", [0.838, 1.0], [1.54, 1.7], grasp(1.5, 0.1), 0.0),
            full("east", [1.162, 1.0], [1.89, 0.4], grasp(1.5, 0.1), apart(0.89, 0.455, 0.2)),
        ]),
        target_grasp: Some(grasp(0.0, 0.7)),
        cost: Some(Cost::new(3)),
        lower_bound: Some(Cost::new(3)),
        optimal: Some(true),
        landmarks: Some(vec![ids(&["cap"]), ids(&["east"]), ids(&["west"])]),
        ..Statement::default()
    }
}
