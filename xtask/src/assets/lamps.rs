//! Photometric files of lamps that nobody makes: beams from formulas, in the format of IES LM-63-2002.

use std::fmt::Write;

/// Degrees between measured angles.
const STEP: usize = 5;

/// Names and texts.
pub(super) fn all() -> [(&'static str, String); 3] {
    let wave = |degrees: f64, width: f64| (-(degrees / width).powi(2)).exp();
    [
        (
            "narrow.ies",
            text("narrow beam with a halo", &[0], |v, _| 700.0 * wave(v, 14.0) + 90.0 * wave(v, 38.0)),
        ),
        ("batwing.ies", text("batwing", &[0], |v, _| 60.0 + 260.0 * wave(v - 42.0, 16.0))),
        (
            "oval.ies",
            text("oval beam", &[0, 15, 30, 45, 60, 75, 90], |v, h| {
                let across = h.to_radians().sin();
                420.0 * wave(v, 46.0 - 16.0 * across * across)
            }),
        ),
    ]
}

/// A lamp by its candela at vertical and horizontal angles in degrees.
fn text(name: &str, horizontal: &[usize], candela: impl Fn(f64, f64) -> f64) -> String {
    let vertical: Vec<usize> = (0..=90).step_by(STEP).collect();
    let join = |angles: &[usize]| angles.iter().map(usize::to_string).collect::<Vec<_>>().join(" ");
    let mut text = format!(
        "IESNA:LM-63-2002\n[TEST] made by a formula\n[TESTLAB] none\n[ISSUEDATE] none\n[MANUFAC] none\n[LUMINAIRE] {name}\nTILT=NONE\n"
    );
    let _ = writeln!(text, "1 -1 1 {} {} 1 2 0 0 0\n1 1 10", vertical.len(), horizontal.len());
    let _ = writeln!(text, "{}\n{}", join(&vertical), join(horizontal));
    for &h in horizontal {
        // The last angle is level with the lamp: nothing goes there.
        let value = |&v: &usize| if v == 90 { 0.0 } else { candela(v as f64, h as f64) };
        let row: Vec<_> = vertical.iter().map(|v| format!("{:.1}", value(v))).collect();
        let _ = writeln!(text, "{}", row.join(" "));
    }
    text
}
