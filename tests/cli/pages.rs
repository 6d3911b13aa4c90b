//! The pages for people: their links and contents, and the tables that are made from the program.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};
use singulate::config::{Config, SETTINGS, Setting};
use singulate::keys::Keys;

use crate::scenes::CROWD;
use crate::{answered, file, run};

const SCENE: &str = include_str!("../../docs/scene.md");
const OPERATING: &str = "docs/operating.md";

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The pages at the root, in `docs`, with the client examples and with the benches.
fn pages() -> Vec<PathBuf> {
    let inside = |folder: &Path| -> Vec<PathBuf> {
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect()
    };
    let mut folders = vec![root().to_owned(), root().join("docs")];
    for folder in ["client-examples", "benches"].map(|folder| root().join(folder)) {
        folders.extend(inside(&folder).into_iter().filter(|path| path.is_dir()));
        folders.push(folder);
    }
    let files = folders.iter().flat_map(|folder| inside(folder));
    files.filter(|path| path.extension().is_some_and(|extension| extension == "md")).collect()
}

fn read(page: &Path) -> String {
    std::fs::read_to_string(page).unwrap()
}

/// The page's lines outside of fenced blocks.
fn prose(page: &str) -> String {
    page.split("\n```").step_by(2).collect::<Vec<_>>().join("\n")
}

/// The headings below the title.
fn headings(page: &str) -> Vec<String> {
    let prose = prose(page);
    let lines = prose.lines().filter(|line| line.starts_with("##"));
    lines.map(|line| line.trim_start_matches('#').trim().replace('`', "")).collect()
}

/// The anchor of a heading, as a forge makes it.
fn anchor(heading: &str) -> String {
    let kept = |c: char| c.is_alphanumeric() || " -_".contains(c);
    heading.to_lowercase().replace(|c| !kept(c), "").replace(' ', "-")
}

/// The anchors of a page's headings and rows.
fn anchors(page: &str) -> Vec<String> {
    let prose = prose(page);
    let rows = prose.split("<a id=\"").skip(1).map(|rest| rest.split('"').next().unwrap().to_owned());
    headings(page).iter().map(|heading| anchor(heading)).chain(rows).collect()
}

/// The targets of the text's links.
fn links(text: &str) -> Vec<String> {
    text.split("](").skip(1).map(|rest| rest.split(')').next().unwrap().to_owned()).collect()
}

#[test]
fn everything_that_is_linked_is_there() {
    let pages = pages();
    assert!(pages.len() > 20, "{pages:?}");
    for page in pages {
        let text = read(&page);
        for link in links(&prose(&text)) {
            if link.starts_with("https://") || link.starts_with("http://") {
                continue;
            }
            let (file, anchor) = link.split_once('#').unwrap_or((&link, ""));
            let target = if file.is_empty() { page.clone() } else { page.parent().unwrap().join(file) };
            assert!(target.exists(), "{}: {link}", page.display());
            if !anchor.is_empty() {
                let anchors = anchors(&read(&target));
                assert!(anchors.contains(&anchor.to_owned()), "{}: {link}: {anchors:?}", page.display());
            }
        }
    }
}

#[test]
fn a_page_with_more_than_three_headings_begins_with_its_contents() {
    for page in pages() {
        // Has a map in place of contents.
        if page.ends_with("ARCHITECTURE.md") {
            continue;
        }
        let text = read(&page);
        let headings = headings(&text);
        if headings.len() <= 3 {
            continue;
        }
        let beginning = text.lines().take(15).collect::<Vec<_>>().join("\n");
        let first = links(&beginning).iter().any(|link| *link == format!("#{}", anchor(&headings[0])));
        assert!(first, "{} does not begin with its contents", page.display());
        // Links may be broken over lines; the contents end with an empty line.
        let (_, rest) = text.split_once(&format!("](#{})", anchor(&headings[0]))).unwrap();
        let listed = links(&rest.split("\n\n").next().unwrap().replace('\n', " "));
        let expected: Vec<String> = headings[1..].iter().map(|heading| format!("#{}", anchor(heading))).collect();
        assert!(listed == expected, "{}: {listed:?}, not {expected:?}", page.display());
    }
}

#[test]
fn a_file_that_curl_sends_keeps_its_lines() {
    let texts = pages().into_iter().map(|page| read(&page)).collect::<Vec<_>>();
    let lines = texts.iter().flat_map(|text| text.lines());
    let lines: Vec<&str> = lines.filter(|line| line.contains(" @") && line.contains("application/json")).collect();
    assert!(lines.len() >= 4, "{lines:?}");
    for line in lines {
        assert!(line.contains(" --data-binary @") && !line.contains(" -d @"), "the lines of the file are lost: {line}");
    }
}

/// The files that the commands of a page make, by what they are made with.
fn made_files(page: &str) -> Vec<&str> {
    let blocks = page.split("```").skip(1).step_by(2).filter(|block| block.starts_with("sh"));
    let words: Vec<&str> = blocks.flat_map(str::split_whitespace).collect();
    let makes = ["-keyout", "-out", "--api-keys-file", "-extfile", ">"];
    let made = words.windows(2).filter(|pair| makes.contains(&pair[0])).map(|pair| pair[1].trim_end_matches(')'));
    made.collect()
}

#[test]
fn git_ignores_every_key_and_certificate_that_the_pages_make() {
    let made = made_files(include_str!("../../docs/operating.md"));
    assert!(
        ["keys.toml", "singulate.key", "authority.pem", "robot-1.csr"].iter().all(|file| made.contains(file)),
        "{made:?}"
    );
    let ignored: Vec<&str> = include_str!("../../.gitignore").lines().collect();
    // openssl's -CAcreateserial makes one beside the authority.
    for file in [&made[..], &made_files(include_str!("../../README.md")), &["authority.srl"]].concat() {
        let kind = format!("*.{}", file.rsplit('.').next().unwrap());
        assert!(ignored.contains(&file) || ignored.contains(&kind.as_str()), "{file}");
    }
}

#[test]
fn the_keys_file_that_is_shown_is_sound() {
    let page = read(&root().join(OPERATING));
    let shown = page.split("```toml\n").nth(1).unwrap().split("```").next().unwrap();
    Keys::open(&file("shown-keys.toml", shown)).unwrap();
}

/// What a setting may be: its range where it is a number, the help's placeholder where it is not.
fn values(setting: &Setting) -> String {
    let refused = setting.set(&mut Config::default(), "?").err().unwrap_or_default();
    let range = refused.split_once(" number from ").map(|(_, range)| range.to_owned());
    range.unwrap_or_else(|| format!("`{}`", setting.placeholder.replace('|', "\\|")))
}

/// The table of settings, as the page has it.
fn table_of_settings() -> String {
    let mut table = "| Flag of `serve` | Variable | Key | Default | Values | Meaning |\n".to_owned();
    table += "| --- | --- | --- | --- | --- | --- |\n";
    for setting in SETTINGS {
        let default = match setting.name {
            "threads" | "job_threads" => "one per core".to_owned(),
            _ => format!("`{}`", setting.get(&Config::default())),
        };
        let (flag, variable, key) = (setting.flag(), setting.variable(), setting.name);
        let help = setting.help.replace('|', "\\|");
        table += &format!("| `--{flag}` | `{variable}` | `{key}` | {default} | {} | {help} |\n", values(setting));
    }
    table
}

/// Where settings are meant to change, `SETTINGS=write` rewrites the table.
#[test]
fn the_table_of_settings_is_made_from_the_settings() {
    let page = read(&root().join(OPERATING));
    let (start, end) = ("<!-- settings -->\n", "<!-- end of settings -->\n");
    let (before, rest) = page.split_once(start).unwrap();
    let (table, after) = rest.split_once(end).unwrap();
    if std::env::var("SETTINGS").is_ok_and(|value| value == "write") {
        std::fs::write(root().join(OPERATING), format!("{before}{start}{}{end}{after}", table_of_settings())).unwrap();
        return;
    }
    assert!(table == table_of_settings(), "rewrite it: SETTINGS=write cargo test --test cli the_table_of_settings");
}

/// A field of a scene: name, unit, range, default.
type Field = [String; 4];

/// The schema that this one refers to, or itself.
fn resolved<'a>(document: &'a Value, schema: &'a Value) -> &'a Value {
    let reference = schema["$ref"].as_str().or_else(|| schema["oneOf"][0]["$ref"].as_str());
    reference.map_or(schema, |reference| document.pointer(reference.trim_start_matches('#')).unwrap())
}

/// The fields of an object of the interface document, and those of the objects in it.
fn fields(document: &Value, object: &Value, prefix: &str, found: &mut BTreeSet<Field>) {
    for (own, property) in object["properties"].as_object().unwrap() {
        let (schema, name) = (resolved(document, property), format!("{prefix}{own}"));
        if schema["properties"].is_object() {
            fields(document, schema, &format!("{name}."), found);
            continue;
        }
        let required = object["required"].as_array().is_some_and(|all| all.contains(&Value::from(own.as_str())));
        let (unit, range) = unit_and_range(property["description"].as_str().unwrap(), schema);
        let absent = if required { String::new() } else { default(property["description"].as_str().unwrap()) };
        found.insert([format!("`{name}`"), unit, range, absent]);
        let items = resolved(document, &schema["items"]);
        if items["properties"].is_object() {
            fields(document, items, &format!("{name}[]."), found);
        }
    }
}

fn unit_and_range(description: &str, schema: &Value) -> (String, String) {
    if schema["oneOf"].is_array() {
        return (String::new(), "[by its kind](#shapes)".to_owned());
    }
    let words = |list: &[&str]| list.iter().map(|word| format!("`{word}`")).collect::<Vec<_>>().join(", ");
    let kind = schema["type"].as_str().or_else(|| schema["type"][0].as_str()).unwrap();
    let number = |name: &str| schema[name].as_f64().unwrap();
    let (unit, range) = match kind {
        "boolean" if description.starts_with("Always true") => ("bool", words(&["true"])),
        "boolean" => ("bool", words(&["true", "false"])),
        "array" if schema["maxItems"].is_null() => ("", "list".to_owned()),
        "array" if schema["minItems"].is_null() => ("", format!("up to {} items", schema["maxItems"])),
        "array" => ("", format!("{} to {} items", schema["minItems"], schema["maxItems"])),
        "string" if schema["enum"].is_array() => {
            let all: Vec<&str> = schema["enum"].as_array().unwrap().iter().map(|word| word.as_str().unwrap()).collect();
            ("word", words(&all))
        }
        "string" if schema["minLength"].is_null() => ("text", format!("up to {} characters", schema["maxLength"])),
        "string" => ("text", format!("{} to {} characters", schema["minLength"], schema["maxLength"])),
        _ => {
            let stated =
                |unit: &&&str| [".", ";", ","].iter().any(|end| description.contains(&format!(", {unit}{end}")));
            let unit = ["m", "rad", "ms"].iter().find(stated).unwrap_or(&"count");
            assert!(*unit != "count" || kind == "integer", "no unit: {description}");
            let range = format!("{} to {}", number("minimum"), number("maximum"));
            let range = range.replace(&core::f64::consts::FRAC_PI_2.to_string(), "π/2");
            (*unit, range.replace(&core::f64::consts::PI.to_string(), "π"))
        }
    };
    (unit.to_owned(), range)
}

/// The default that the description states.
fn default(description: &str) -> String {
    let stated = description.split_once("Default: ").and_then(|(_, rest)| rest.split_whitespace().next());
    match stated.map(|value| value.trim_end_matches(['.', ';', ','])) {
        None => "none".to_owned(),
        Some("false") => "`false`".to_owned(),
        Some(value) => value.to_owned(),
    }
}

#[test]
fn the_table_of_the_scene_is_that_of_the_interface_document() {
    let document: Value = serde_json::from_str(include_str!("../../openapi/openapi.json")).unwrap();
    let mut expected = BTreeSet::new();
    fields(&document, &document["components"]["schemas"]["SceneBody"], "", &mut expected);
    assert!(expected.len() > 25, "{expected:?}");
    let table = SCENE.split("\n## Fields\n").nth(1).unwrap().split("\n## ").next().unwrap();
    let rows = table.lines().filter(|line| line.starts_with("| `"));
    let cells = rows.map(|row| row.trim_matches('|').split('|').map(|cell| cell.trim().to_owned()).collect::<Vec<_>>());
    let listed: BTreeSet<Field> = cells.map(|row| row[..4].to_vec().try_into().unwrap()).collect();
    let (missing, wrong) = (expected.difference(&listed), listed.difference(&expected));
    assert!(listed == expected, "missing {:?}, wrong {:?}", missing.collect::<Vec<_>>(), wrong.collect::<Vec<_>>());
}

/// The step and the goal on the page of scenes, for the table of the README.
#[test]
fn the_goal_and_the_step_that_are_shown_are_sound() {
    let blocks: Vec<Value> = SCENE
        .split("```json\n")
        .skip(1)
        .map(|rest| rest.split("```").next().unwrap())
        .map(|text| serde_json::from_str(text).unwrap())
        .collect();
    let [step, goal] = &blocks[..] else { panic!("two blocks: {blocks:?}") };
    let mut scene: Value = serde_json::from_str(CROWD).unwrap();
    scene.as_object_mut().unwrap().remove("target");
    scene.as_object_mut().unwrap().extend(goal.as_object().unwrap().clone());
    let scene = file("shown-goal.json", &scene.to_string());
    let cleared: Value = serde_json::from_str(&answered(run(&["plan", scene.to_str().unwrap()]))).unwrap();
    assert_eq!((&cleared["verdict"], &cleared["proven"]), (&json!("cleared"), &json!(true)), "{cleared}");
    let plan = file("shown-step.json", &json!({"relocations": [step]}).to_string());
    let arguments = ["verify", scene.to_str().unwrap(), plan.to_str().unwrap(), "--partial"];
    let verified: Value = serde_json::from_str(&answered(run(&arguments))).unwrap();
    assert_eq!(verified["valid"], true, "{verified}");
}
