//! A scene whose survey takes minutes.

use serde_json::{Value, json};

/// Dishes in rows, at such a distance that about half of them can be freed, by many relocations: the survey of them all
/// takes minutes.
pub(crate) fn hard(time_limit_ms: u64) -> Value {
    let (count, pitch) = (60, 0.112);
    let mut state: u32 = 5;
    let mut random = |least: f64, width: f64| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        least + width * f64::from(state >> 16) / 65_536.0
    };
    let dishes = (0..count * count).map(|n| {
        let (row, column) = (n / count, n % count);
        let shift = 0.5 * f64::from(row % 2);
        let x = 0.1 + pitch * (f64::from(column) + shift) + random(-0.004, 0.008);
        let y = 0.1 + pitch * 0.866 * f64::from(row) + random(-0.004, 0.008);
        json!({"id": format!("d{n}"), "x": x, "y": y, "radius": random(0.045, 0.005)})
    });
    json!({
        "table": {"x_min": 0, "y_min": 0, "x_max": 7.2, "y_max": 7.2},
        "gripper": {"fingers": 3, "finger_width": 0.015, "clearance": 0.05},
        "objects": dishes.collect::<Vec<_>>(),
        "target": "d0",
        "settings": {"time_limit_ms": time_limit_ms}
    })
}
