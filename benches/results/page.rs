//! `docs/RESULTS.md` and its pictures, from the files in `docs/results/`.

use std::fs;
use std::path::Path;

use serde::de::DeserializeOwned;

use crate::markdown::{self, wrapped};
use crate::peers::Peers;
use crate::robot::Robot;
use crate::tables::{Table1, Table2};
use crate::{noise_page, noise_plot, peers_page, plots, robot_page, table_plots, tables_page};

const HEAD: &str = "# Results\n\n\
    `cargo bench --bench results` writes this page and its pictures from the files in [`results/`](results/): every \
    figure here comes from them. They were measured on a shared machine with 2 cores. Figures that are compared with each \
    other come from the same run, except for the paper's own. Robots and their world are simulated: no figure here is from a real \
    one.\n\n";

/// Every file that is made, with its path below the crate's root and its text.
pub(crate) fn files() -> Vec<(&'static str, String)> {
    let (table1, table2, peers): (Table1, Table2, Peers) =
        (read("table1.json"), read("table2.json"), read("peers.json"));
    let robot = robot();
    let sections = [
        written_by(&table1, &table2, &robot),
        peers_page::section(&peers),
        tables_page::table1(&table1),
        tables_page::table2(&table2),
        robot_page::table3(&robot.table3),
        tables_page::apart(&table1, &table2),
        robot_page::relocations(&robot.relocations, &robot.tolerance),
        noise_page::noise(&robot.noise),
        noise_page::controller(&robot.controller),
        robot_page::hand(&robot.hand),
        robot_page::palm(&robot.palm),
    ];
    let drawn = "finite figures";
    let text = sections.join("\n");
    vec![
        ("docs/RESULTS.md", wrapped(&format!("{HEAD}{}\n\n{text}", markdown::contents(&text)))),
        ("docs/results/peers.svg", plots::peers(&peers).expect(drawn)),
        ("docs/results/deadlocks.svg", table_plots::deadlocks(&table1).expect(drawn)),
        ("docs/results/times.svg", table_plots::times(&table1).expect(drawn)),
        ("docs/results/noise.svg", noise_plot::success(&robot.noise).expect(drawn)),
    ]
}

fn robot() -> Robot {
    Robot {
        table3: read("table3.json"),
        relocations: read("relocations.json"),
        tolerance: read("tolerance.json"),
        noise: read("noise.json"),
        controller: read("controller.json"),
        hand: read("hand.json"),
        palm: read("palm.json"),
    }
}

/// The files, each with the command that writes it.
fn written_by(table1: &Table1, table2: &Table2, robot: &Robot) -> String {
    let code = |text: &str| format!("`{text}`");
    let mut rows = vec![
        markdown::row(["file", "written by"]),
        markdown::row(["`table1.json`", &code(&table1.command())]),
        markdown::row(["`table2.json`", &code(&table2.command())]),
        markdown::row(["`peers.json`", "`benches/peers/run --out docs/results/peers.json`"]),
    ];
    rows.extend(robot.commands().map(|(name, command)| {
        markdown::row([&code(&format!("{name}.json")), &code(&format!("{command} --out docs/results/{name}.json"))])
    }));
    markdown::table(&rows)
}

fn read<T: DeserializeOwned>(name: &str) -> T {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/results").join(name);
    let text = fs::read_to_string(&path).expect("the committed figures");
    serde_json::from_str(&text).expect("what its command writes")
}
