//! Peak memory of one whole answer, each case in a process of its own: from the request body to the response.
//!
//! Fails where one takes more than 100 MB. Linux only: reads the peak from `/proc`.

mod cases;
#[path = "cases/hard.rs"]
mod hard;

use std::env;
use std::fs;
use std::process::{Command, ExitCode};

use singulate::experiments::Recipe;
use singulate::wire::{AnswerBody, RequestLimits, read_scene};
use singulate_planner::budget::Budget;
use singulate_planner::paper::plan_by;
use singulate_planner::plan::PlanError;
use singulate_planner::scene::{
    GoalDraft, GripperDraft, ObjectDraft, RectangleDraft, SceneDraft, ShapeDraft, TableDraft,
};
use singulate_planner::search::SILENT;

const MAX_PEAK_KB: u64 = 100_000;
/// A name, a scene, and settings in which it names one of the paper's methods.
type Case = (&'static str, fn() -> SceneDraft, &'static str);

const CASES: [Case; 14] = [
    ("10,000 dishes at 45 %", || cases::equal_density(10_000, 0), "{}"),
    ("10,000 dishes at 45 %, the deepest target", || hard::freed_last(cases::equal_density(10_000, 0)), "{}"),
    ("a pressed cluster of 1,000", || hard::pressed(1000, 0), "{}"),
    ("10,000 crumbs, a clearance of 5 mm", || hard::crumbs(2.0, 0.005), "{}"),
    ("10,000 crumbs, a clearance of 6 mm", || hard::crumbs(2.0, 0.006), "{}"),
    ("10,000 crumbs, a clearance of 7 mm", || hard::crumbs(2.0, 0.007), "{}"),
    ("10,000 crumbs, a clearance of 16.5 mm", || hard::crumbs(4.0, 0.0165), "{}"),
    ("a plate among crumbs", plate_among_crumbs, "{}"),
    ("a plate that has to move among crumbs", plate_to_move, "{}"),
    ("a plan of 299 steps among 9,900 objects", stair, "{}"),
    ("10,000 dishes, sectors", || cases::equal_density(10_000, 0), r#"{"grasp_model":"sector"}"#),
    ("a deep cluster of 100, LOBS", || hard::too_much_for_lobs(), r#"{"search":"lobs"}"#),
    (
        "200 dishes, a locked target, forward A*",
        || hard::locked(cases::equal_density(200, 0)),
        r#"{"search":"forward_astar"}"#,
    ),
    ("2,500 dishes, raster", || hard::freed_last(cases::equal_density(2500, 0)), r#"{"placement":"raster"}"#),
];

fn main() -> ExitCode {
    // `cargo bench` passes `--bench`; a child gets its case.
    if let Some(case) = env::args().nth(1).and_then(|argument| argument.parse::<usize>().ok()) {
        answer(case);
        return ExitCode::SUCCESS;
    }
    let mut within = true;
    for (at, (name, ..)) in CASES.iter().enumerate() {
        let child = Command::new(env::current_exe().expect("a path")).arg(at.to_string()).output().expect("a child");
        let text = String::from_utf8_lossy(&child.stdout);
        let (peak, verdict) = text.trim().split_once(' ').unwrap_or(("", "failed"));
        let kb: u64 = peak.parse().unwrap_or(u64::MAX);
        println!("{name:<44} {:>8.1} MB   {verdict}", f64::from(u32::try_from(kb).unwrap_or(u32::MAX)) / 1000.0);
        within &= kb <= MAX_PEAK_KB;
    }
    println!("at most {} MB", MAX_PEAK_KB / 1000);
    if within { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

fn answer(case: usize) {
    let (_, draft, settings) = CASES[case];
    let body = json(&draft(), settings);
    let verdict = match read_scene(body.as_bytes(), &RequestLimits::default()) {
        Err(problem) => format!("refused: {}", problem.errors()[0].code),
        Ok(request) => match plan_by(&request.methods, &request.scene, &request.settings, &Budget::unlimited(), SILENT)
        {
            Err(PlanError::TooDense) => "refused: too_dense".to_owned(),
            Err(PlanError::Refused(report)) => panic!("{report:?}"),
            Ok(judged) => {
                let bytes = serde_json::to_vec(&AnswerBody::new(&request, &judged)).expect("JSON").len();
                format!("{}, {bytes} bytes", judged.statement().verdict_name())
            }
        },
    };
    let status = fs::read_to_string("/proc/self/status").expect("Linux");
    let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).expect("a peak");
    println!("{} {verdict}", peak.trim().trim_end_matches(" kB"));
}

/// The draft as a request body, written piece by piece: its own memory must not count.
fn json(draft: &SceneDraft, settings: &str) -> String {
    let number = |value: Option<f64>| value.expect("a full draft");
    let object = |object: &ObjectDraft| {
        let id = object.id.as_deref().expect("an id");
        let (x, y, radius) = (number(object.x), number(object.y), number(object.shape.disc_radius()));
        format!(r#"{{"id":"{id}","x":{x},"y":{y},"radius":{radius},"fixed":{}}}"#, object.fixed)
    };
    let objects: Vec<String> = draft.objects.iter().map(object).collect();
    let (top, gripper) = (&draft.table.top, &draft.gripper);
    let Some(GoalDraft::Target(target)) = &draft.goal else { panic!("a target") };
    format!(
        r#"{{"table":{{"x_min":{},"y_min":{},"x_max":{},"y_max":{}}},"gripper":{{"fingers":{},"finger_width":{},"clearance":{}}},"objects":[{}],"target":"{}","settings":{settings}}}"#,
        number(top.x_min),
        number(top.y_min),
        number(top.x_max),
        number(top.y_max),
        number(gripper.fingers),
        number(gripper.finger_width),
        number(gripper.clearance),
        objects.join(","),
        target,
    )
}

/// One large plate among some 7,000 crumbs.
fn plate_among_crumbs() -> SceneDraft {
    let mut draft = hard::crumbs(3.0, 0.0165);
    let beside = |crumb: &ObjectDraft| {
        let (x, y) = (crumb.x.unwrap_or_default() - 0.12, crumb.y.unwrap_or_default() - 0.12);
        (x * x + y * y).sqrt() > 0.0765
    };
    draft.objects.retain(beside);
    let plate = ObjectDraft {
        id: Some("plate".into()),
        x: Some(0.12),
        y: Some(0.12),
        shape: ShapeDraft::disc(0.075),
        ..ObjectDraft::default()
    };
    draft.objects.push(plate);
    draft.goal = Some(GoalDraft::Target("plate".into()));
    draft
}

/// A plate of two metres that has to leave, and some 8,900 crumbs on the rest of the table: it may stand beside any of them.
fn plate_to_move() -> SceneDraft {
    let disc = |id: String, (x, y): (f64, f64), radius: f64, fixed: bool| ObjectDraft {
        id: Some(id),
        x: Some(x),
        y: Some(y),
        shape: ShapeDraft::disc(radius),
        fixed,
        ..ObjectDraft::default()
    };
    let (cup, plate) = ((3.0, 3.0), (4.035, 3.0));
    let mut objects = vec![
        disc("cup".into(), cup, 0.03, false),
        disc("plate".into(), plate, 1.0, false),
        disc("post-0".into(), (2.955, 3.078), 0.05, true),
        disc("post-1".into(), (2.955, 2.922), 0.05, true),
    ];
    let apart = |(x, y): (f64, f64), from: (f64, f64)| {
        let (x, y) = (x - from.0, y - from.1);
        (x * x + y * y).sqrt()
    };
    for n in 0..10_000_u32 {
        let at = (0.03 + 0.062 * f64::from(n % 100), 0.03 + 0.062 * f64::from(n / 100));
        if apart(at, plate) > 1.12 && apart(at, cup) > 0.25 {
            objects.push(disc(format!("crumb-{n}"), at, 0.002, false));
        }
    }
    let top = RectangleDraft { x_min: Some(0.0), y_min: Some(0.0), x_max: Some(6.2), y_max: Some(6.2) };
    let table = TableDraft { top, keep_out: Vec::new() };
    SceneDraft {
        table,
        gripper: Recipe::default().gripper,
        objects,
        goal: Some(GoalDraft::Target("cup".into())),
        ..SceneDraft::default()
    }
}

/// A stair on whose steps each disc can only be gripped along the way to the next one, which stands in that way; crumbs
/// that can't be moved keep the fingers from all other yaws. Beside it a field of discs that nothing hinders.
fn stair() -> SceneDraft {
    let disc = |id: String, x: f64, y: f64, radius: f64, fixed: bool| ObjectDraft {
        id: Some(id),
        x: Some(x),
        y: Some(y),
        shape: ShapeDraft::disc(radius),
        fixed,
        ..ObjectDraft::default()
    };
    let step = |n: u32| {
        let (x, y) = (0.12 * f64::from(n.div_ceil(2)), 0.12 * f64::from(n / 2));
        let crumbs = [(0.06, 0.0), (0.0425, 0.0425), (0.0425, -0.0425)].into_iter().zip(0..).map(move |(crumb, at)| {
            let (dx, dy) = if n.is_multiple_of(2) { (crumb.1, crumb.0) } else { crumb };
            disc(format!("crumb-{n}-{at}"), x + dx, y + dy, 0.005, true)
        });
        core::iter::once(disc(format!("step-{n}"), x, y, 0.05, false)).chain(crumbs)
    };
    let far = |n: u32| disc(format!("far-{n}"), 20.0 + 0.3 * f64::from(n % 94), 0.3 * f64::from(n / 94), 0.05, false);
    let top = RectangleDraft { x_min: Some(-1.0), y_min: Some(-1.0), x_max: Some(50.0), y_max: Some(30.0) };
    let gripper = GripperDraft {
        fingers: Some(2.0),
        finger_width: Some(0.06),
        clearance: Some(0.03),
        ..Recipe::default().gripper
    };
    SceneDraft {
        table: TableDraft { top, keep_out: Vec::new() },
        gripper,
        objects: (0..300).flat_map(step).chain((0..8700).map(far)).collect(),
        goal: Some(GoalDraft::Target("step-0".into())),
        ..SceneDraft::default()
    }
}
