//! Whether a pilot run has seen enough for decisions about a scene.

use crate::pilot::Pilot;
use crate::scene::Scene;

/// Fewer events say little: their number alone is then uncertain by more than a fifth (1/√20).
pub(crate) const LEAST: u64 = 20;

/// What a pilot of a scene has seen too little of; nothing where it is enough.
pub(crate) fn lacking(scene: &Scene, pilot: &Pilot) -> Option<String> {
    let tally = &pilot.outcome.tally;
    let fits = |k: &usize| scene.classes[*k].diameter_mm < scene.screen.aperture_mm;
    let narrow = (0..scene.classes.len()).filter(fits);
    let able: u64 = narrow.map(|k| pilot.counts[k]).sum();
    // What is retained, which decides, is what has not come that far.
    let collected: u64 = tally.collected.iter().sum();
    let formed = tally.counts.formed;
    let mut lacking = Vec::new();
    // A scene of a few spheres has shown what it can once all have passed.
    if collected < LEAST.min(able) || collected == 0 {
        let seen = if collected == 0 { "none".to_owned() } else { collected.to_string() };
        lacking.push(format!(
            "{seen} of the {able} spheres that are narrower than an aperture passed the screen and were \
             collected"
        ));
    }
    let wet = scene.liquid.as_ref().is_some_and(|liquid| liquid.moisture_percent > 0.0);
    if wet && formed < LEAST {
        lacking.push(format!("{formed} bridges formed"));
    }
    (!lacking.is_empty()).then(|| lacking.join(", and "))
}

/// What to say instead of a proposal.
pub(crate) fn too_little(scene: &Scene, lacking: &str, whole_time: f64) -> String {
    let more = match scene.time < whole_time {
        true => format!("a longer --time, up to the scene's {whole_time} s"),
        false => "a longer `time` of the scene and --time".into(),
    };
    format!(
        "too little to go by: in {} s {lacking}; a proposal takes {LEAST} spheres (or all of them) and, \
         with liquid, {LEAST} bridges\n\
         nothing is proposed, and no share above is a reason to leave a force out: take {more}",
        scene.time
    )
}
