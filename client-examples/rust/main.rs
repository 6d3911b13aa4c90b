//! Frees the target of a scene, move by move: `cargo run --release --example cell -- SCENE.json`

mod answer;
mod service;

use std::process::ExitCode;

use answer::{Answer, Relocation};
use serde_json::Value;
use service::{Failure, Service};

const ROUNDS: usize = 100;
/// The service's own limits, where its operator has not changed them.
const DEFAULT_LIMIT_MS: u64 = 1000;
const LONGEST_LIMIT_MS: u64 = 60_000;
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
    free(&service, scene).await
}

/// Plan, carry out a relocation, go on with the plan if it still holds; 0 once the target is grasped.
async fn free(service: &Service, mut scene: Value) -> Result<ExitCode, Failure> {
    let named_ms = scene.pointer("/settings/time_limit_ms").and_then(Value::as_u64);
    let limit_ms = named_ms.unwrap_or(DEFAULT_LIMIT_MS).min(LONGEST_LIMIT_MS);
    let mut answer = planned(service, &scene, limit_ms).await?;
    for _ in 0..ROUNDS {
        let mut plan = match answer {
            Answer::Plan(plan) => plan,
            Answer::Deadlock(core) => return Ok(report("deadlock", &core, "hold each other", 3)),
            Answer::NoSpace(needed) => return Ok(report("no space", &needed, "would have to go", 4)),
            Answer::TimedOut(needed) => return Ok(report("timed out", &needed, "would have to go", 5)),
        };
        let Some(step) = plan.next_step() else {
            println!("grasp {} at {}", plan.target, number(plan.yaw));
            return Ok(ExitCode::SUCCESS);
        };
        relocate(&mut scene, &step)?;
        let replan = service.replan(&scene, &plan, POSITION_TOLERANCE, limit_ms).await?;
        answer = if replan { planned(service, &scene, limit_ms).await? } else { Answer::Plan(plan) };
    }
    Err(Failure::Other(format!("gave up: the target is not free after {ROUNDS} moves")))
}

/// What comes too late is asked for once more, with ten times the time.
async fn planned(service: &Service, scene: &Value, limit_ms: u64) -> Result<Answer, Failure> {
    let answer = service.plan(scene, limit_ms).await?;
    if !matches!(answer, Answer::TimedOut(_)) {
        return Ok(answer);
    }
    let longer_ms = limit_ms.saturating_mul(10).min(LONGEST_LIMIT_MS);
    let mut patient = scene.clone();
    patient["settings"]["time_limit_ms"] = longer_ms.into();
    service.plan(&patient, longer_ms).await
}

/// Stands for the robot. A real one moves the object, looks at the table again, and makes its next scene of that.
fn relocate(scene: &mut Value, step: &Relocation) -> Result<(), Failure> {
    let objects = scene["objects"].as_array_mut().map(Vec::as_mut_slice).unwrap_or_default();
    let Some(moved) = objects.iter_mut().find(|object| object["id"] == step.object.as_str()) else {
        return Err(Failure::Other(format!("no object '{}' in the scene", step.object)));
    };
    moved["x"] = step.to.x.into();
    moved["y"] = step.to.y.into();
    let [from_x, from_y, to_x, to_y] = [step.from.x, step.from.y, step.to.x, step.to.y].map(number);
    let [grasp, release] = [step.grasp.yaw, step.release.yaw].map(number);
    let object = &step.object;
    println!("move {object} from {from_x} {from_y} to {to_x} {to_y}, grasp at {grasp}, release at {release}");
    Ok(())
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

/// Millimetres and milliradians; what rounds to zero has no sign.
fn number(value: f64) -> String {
    let text = format!("{value:.3}");
    if text == "-0.000" { "0.000".to_owned() } else { text }
}
