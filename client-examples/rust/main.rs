//! Reaches the goal of a scene, step by step: `cargo run --release --example cell -- SCENE.json`

mod answer;
mod scene;
mod service;

use std::process::ExitCode;

use answer::{Answer, End, Grasp, Pose, Relocation, Removal, Step};
use scene::Scene;
use service::{Failure, Service};

const ROUNDS: usize = 100;
/// How far beside its place an object may be seen, m: the errors of this cell's robot and camera.
const POSITION_TOLERANCE: f64 = 0.005;

#[tokio::main(flavor = "current_thread")]
async fn main() -> ExitCode {
    let Some((path, None)) = std::env::args().nth(1).map(|path| (path, std::env::args().nth(2))) else {
        eprintln!("how to call it: cell SCENE.json");
        return ExitCode::FAILURE;
    };
    match run(&path).await {
        Ok(status) => status,
        Err(Failure::Invalid(faults)) => {
            for fault in faults {
                eprintln!("{} {}: {}", fault.code, fault.pointer, fault.detail);
            }
            ExitCode::from(2)
        }
        Err(Failure::Forbidden(title)) => {
            eprintln!("{title}");
            ExitCode::from(6)
        }
        Err(Failure::Other(reason)) => {
            eprintln!("{reason}");
            ExitCode::FAILURE
        }
    }
}

async fn run(path: &str) -> Result<ExitCode, Failure> {
    let text = std::fs::read_to_string(path).map_err(|error| Failure::Other(format!("{path}: {error}")))?;
    let scene = serde_json::from_str(&text).map_err(|error| Failure::Other(format!("{path}: {error}")))?;
    let url = std::env::var("SINGULATE_URL").unwrap_or_else(|_| "http://127.0.0.1:8080".to_owned());
    let key = std::env::var("SINGULATE_KEY").ok().filter(|key| !key.is_empty());
    let service = Service::new(&url, key)?;
    reach(&service, Scene(scene)).await
}

/// Plan, carry out a step, go on with the plan if it still holds; 0 once the goal is reached.
async fn reach(service: &Service, mut scene: Scene) -> Result<ExitCode, Failure> {
    let mut answer = planned(service, &scene).await?;
    for _ in 0..ROUNDS {
        let mut plan = match answer {
            Answer::Plan(plan) => plan,
            Answer::Deadlock(core) => return Ok(report("deadlock", &core, "hold each other", 3)),
            Answer::NoSpace(needed) => return Ok(report("no space", &needed, "would have to go", 4)),
            Answer::TimedOut(needed) => return Ok(report("timed out", &needed, "would have to go", 5)),
        };
        let Some(step) = plan.next_step() else { return Ok(finish(&plan.end)) };
        carry_out(&mut scene, &step)?;
        let replan = !plan.is_done() && service.replan(&scene, &plan, POSITION_TOLERANCE).await?;
        answer = if replan { planned(service, &scene).await? } else { Answer::Plan(plan) };
    }
    Err(Failure::Other(format!("gave up: the goal is not reached after {ROUNDS} moves")))
}

/// What comes too late is asked for once more, with ten times the time.
async fn planned(service: &Service, scene: &Scene) -> Result<Answer, Failure> {
    let answer = service.plan(scene).await?;
    if matches!(answer, Answer::TimedOut(_)) { service.plan(&scene.with_more_time()).await } else { Ok(answer) }
}

/// Stands for the robot. A real one moves the object, looks at the table again, and makes its next scene of that.
fn carry_out(scene: &mut Scene, step: &Step) -> Result<(), Failure> {
    match step {
        Step::Relocation(Relocation { object, from, to, grasp, release, turn }) => {
            scene.put(object, to)?;
            let turned = turn.map(|turn| format!(", turned by {}", number(turn))).unwrap_or_default();
            let [from, to] = [from, to].map(place);
            let [grasp, release] = [grasp, release].map(grip);
            println!("move {object} from {from} to {to}{turned}, grasp at {grasp}, release at {release}");
        }
        Step::Removal(Removal { object, from, grasp, drop_off }) => {
            scene.take_away(object, drop_off)?;
            println!("take {object} from {} away to {drop_off}, grasp at {}", place(from), grip(grasp));
        }
    }
    Ok(())
}

/// The end of a plan; 0 if it reaches the goal.
fn finish(end: &End) -> ExitCode {
    match end {
        End::Grasp { target, grasp } => println!("grasp {target} at {}", grip(grasp)),
        End::AllAway => println!("all taken away"),
        End::Cleared => println!("cleared"),
        End::PartlyCleared(remains) => {
            if let Some(lock) = &remains.stuck {
                report("stuck", &lock.core, "hold each other", 7);
            }
            let what = if remains.proven { "left" } else { "left, as far as is known" };
            return report("partly cleared", &remains.left, what, 7);
        }
    }
    ExitCode::SUCCESS
}

/// The words alone where no ids are known.
fn report(words: &str, ids: &[String], what: &str, status: u8) -> ExitCode {
    if ids.is_empty() {
        println!("{words}");
    } else {
        println!("{words}: {} {what}", ids.join(", "));
    }
    ExitCode::from(status)
}

fn place(pose: &Pose) -> String {
    let yaw = pose.yaw.map(|yaw| format!(" {}", number(yaw))).unwrap_or_default();
    format!("{} {}{yaw}", number(pose.x), number(pose.y))
}

fn grip(grasp: &Grasp) -> String {
    format!("{} {} {}", number(grasp.x), number(grasp.y), number(grasp.yaw))
}

/// Millimetres and milliradians; what rounds to zero has no sign.
fn number(value: f64) -> String {
    let text = format!("{value:.3}");
    if text == "-0.000" { "0.000".to_owned() } else { text }
}
