//! Drop-offs and the steps that lead there.

use super::rows::{DropOff, THREE, all, drawn, dropped, groups, number, placed, plan, row, sound};
use super::*;

#[test]
fn a_step_off_the_table_leads_from_its_old_place_into_its_tray() {
    let scene = sound(row(THREE, all(&["c"]), &[("bin", None, None), ("tray", Some(4.0), None)]));
    let steps = vec![placed(&scene, 0), dropped(&scene, 1, "tray"), dropped(&scene, 2, "tray")];
    let drawing = drawn(&scene, plan(Verdict::Relocate, steps));
    assert_eq!(groups(&drawing, "relocation").len(), 3);
    // Of the step on the table at both places.
    assert_eq!(groups(&drawing, "fingers").len(), 4);
    assert!(drawing.contains("2: b to tray") && drawing.contains("bin: empty") && drawing.contains("tray: 2 of 4"));
    let trays = groups(&drawing, "tray");
    let routes = groups(&drawing, "route");
    assert_eq!((trays.len(), routes.len()), (2, 3));
    assert!(number(trays[0], "x") + number(trays[0], "width") < number(trays[1], "x"), "side by side");
    let stated = plan(Verdict::Relocate, Vec::new());
    let view = View::new(&scene, &stated, &Roles::new(&scene, &stated), 0.0);
    let (_, top, _, height) = view.frame();
    for route in &routes[1..] {
        let number_in_tray = groups(route.split("legend").next().unwrap(), "number")[1];
        let (x, y) = (number(number_in_tray, "cx"), number(number_in_tray, "cy"));
        let (left, upper) = (number(trays[1], "x"), number(trays[1], "y"));
        assert!((left..left + number(trays[1], "width")).contains(&x), "{x}");
        assert!((upper..upper + number(trays[1], "height")).contains(&y), "{y}");
        assert!(upper > top + height, "the tray is below the table");
    }
}

#[test]
fn the_numbers_in_a_tray_stand_apart_and_inside() {
    let ids: Vec<String> = (0..60).map(|n| format!("o{n}")).collect();
    let objects: Vec<(&str, f64)> = ids.iter().map(|id| (&id[..], 0.01)).collect();
    let mut draft = row(&objects, GoalDraft::Clear, &[("tray", None, None), ("bin", None, None)]);
    // All above the right end of the left tray.
    for (at, object) in draft.objects.iter_mut().enumerate() {
        (object.x, object.y) = (Some(1.8 + 0.025 * (at % 8) as f64), Some(0.1 + 0.1 * (at / 8) as f64));
    }
    let scene = sound(draft);
    let drawing = drawn(&scene, plan(Verdict::Cleared, (0..60).map(|at| dropped(&scene, at, "tray")).collect()));
    let tray = groups(&drawing, "tray")[0];
    let (left, upper) = (number(tray, "x"), number(tray, "y"));
    let places = groups(&drawing, "route").into_iter().map(|route| {
        let end = groups(route.split("legend").next().unwrap(), "number")[1];
        Point2::new(number(end, "cx"), number(end, "cy"))
    });
    let places: Vec<Point2<f64>> = places.collect();
    for (at, &place) in places.iter().enumerate() {
        assert!((left + 9.0..left + number(tray, "width") - 9.0).contains(&place.x), "{place}");
        assert!((upper + 9.0..upper + number(tray, "height") - 24.0).contains(&place.y), "{place}");
        assert!(places[..at].iter().all(|other| distance(*other, place) > 18.0), "{place}");
    }
}

#[test]
fn the_legend_has_the_signs_of_every_kind_of_step() {
    let scene = sound(row(THREE, all(&["c"]), &[("tray", None, None)]));
    let legend =
        |steps| drawn(&scene, plan(Verdict::Relocate, steps)).split_once("class=\"legend\"").unwrap().1.to_owned();
    let mixed = legend(vec![dropped(&scene, 2, "tray"), placed(&scene, 0)]);
    for text in ["wanted away", "drop-off", "old place", "new place", "order", "fingers picking", "fingers releasing"] {
        assert_eq!(mixed.matches(text).count(), 1, "{text}");
    }
    let dropped = legend(vec![dropped(&scene, 2, "tray")]);
    assert!(dropped.contains("fingers picking") && !dropped.contains("releasing") && !dropped.contains("new place"));
}

#[test]
fn of_many_drop_offs_only_those_are_drawn_that_are_used() {
    let ids: Vec<String> = (0..1000).map(|n| format!("slot-{n}")).collect();
    let slots: Vec<DropOff<'_>> = ids.iter().map(|id| (&id[..], Some(1.0), None)).collect();
    let scene = sound(row(THREE, GoalDraft::Clear, &slots));
    let steps = vec![dropped(&scene, 0, "slot-3"), dropped(&scene, 1, "slot-999")];
    let drawing = drawn(&scene, plan(Verdict::PartlyCleared, steps));
    assert_eq!(groups(&drawing, "tray").len(), 3);
    assert!(["slot-3: 1 of 1", "slot-999: 1 of 1", "and 998 more: empty"].iter().all(|text| drawing.contains(text)));
    assert!(drawing.contains("and 994 more") && !drawing.contains("slot-10"), "the line above names six");
    let unused = drawn(&scene, plan(Verdict::PartlyCleared, Vec::new()));
    assert!(groups(&unused, "tray").len() == 1 && unused.contains("1000 drop-offs: empty"));
}

#[test]
fn what_goes_to_a_drop_off_that_is_not_drawn_goes_to_the_rest() {
    let ids: Vec<String> = (0..40).map(|n| format!("o{n}")).collect();
    let objects: Vec<(&str, f64)> = ids.iter().map(|id| (&id[..], 0.08)).collect();
    let slots: Vec<DropOff<'_>> = ids.iter().map(|id| (&id[..], None, None)).collect();
    let mut draft = row(&objects, GoalDraft::Clear, &slots);
    draft.table.top = rectangle(0.0, 0.0, 20.0, 1.0);
    let scene = sound(draft);
    let steps = (0..40).map(|at| dropped(&scene, at, &ids[at])).collect();
    let drawing = drawn(&scene, plan(Verdict::Cleared, steps));
    assert_eq!((groups(&drawing, "tray").len(), groups(&drawing, "route").len()), (25, 40));
    assert!(drawing.contains("and 16 more: 16 objects"));
}

#[test]
fn ten_thousand_objects_that_are_cleared_give_a_small_drawing() {
    let ids: Vec<String> = (0..10_000).map(|n| format!("o{n}")).collect();
    let ids: Vec<&str> = ids.iter().map(String::as_str).collect();
    let objects: Vec<(&str, f64)> = ids.iter().map(|id| (*id, 0.08)).collect();
    let mut draft = row(&objects, GoalDraft::Clear, &[("tray", None, None)]);
    draft.table.top = rectangle(0.0, 0.0, 41.0, 41.0);
    for (at, object) in draft.objects.iter_mut().enumerate() {
        (object.x, object.y) = (Some(0.4 + 0.4 * (at % 100) as f64), Some(0.4 + 0.4 * (at / 100) as f64));
    }
    let scene = sound(draft);
    let steps = (0..10_000).map(|at| dropped(&scene, at, "tray")).collect();
    let drawing = svg(&scene, &answer(plan(Verdict::Cleared, steps)));
    assert_eq!((groups(&drawing, "relocation").len(), groups(&drawing, "route").len()), (10_000, 100));
    assert!(drawing.contains("order, of the first 100 off the table") && drawing.contains("tray: 10000 objects"));
    assert!(drawing.len() < 5_000_000, "{} bytes", drawing.len());
}

#[test]
fn without_drop_offs_and_wide_objects_nothing_of_them_is_drawn() {
    let scene = scene(&["t", "a", "b"]);
    let drawing = svg(&scene, &relocate(&scene, &[1]));
    for text in ["drop-off", "too-wide", "not-accepted", "tray", "candidate"] {
        assert!(!drawing.contains(text), "{text}");
    }
}

#[test]
fn an_id_of_a_drop_off_is_text_and_never_mark_up() {
    let scene = sound(row(THREE, GoalDraft::Clear, &[("<b>&\u{7}\"", None, None), ("]]>", Some(1e9), None)]));
    let drawing = drawn(&scene, plan(Verdict::Cleared, vec![dropped(&scene, 0, "<b>&\u{7}\"")]));
    assert!(drawing.contains("&lt;b&gt;&amp;") && !drawing.contains("<b>") && !drawing.contains('\u{7}'));
    assert!(drawing.contains("0 of 1000000000"));
}
