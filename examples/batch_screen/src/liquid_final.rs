//! `liquid_final.csv`: where the liquid is at the end, in the four divisions of Elskamp &
//! Kruggel-Emden (2018), Fig. 14; live bridges split as if they broke now.

use std::collections::BTreeMap;
use std::path::Path;

use pendular::dem::{Partner, Simulation};
use pendular::{Account, MeshWalls};

use crate::build::WetTerm;
use crate::build::apparatus::{floor, group};
use crate::error::RunError;
use crate::makeup::Makeup;
use crate::scene::Scene;
use crate::tables::number;
use crate::tally::Tally;

/// The divisions: what no account holds, walls beside the screen, screen with what is not
/// collected, what is collected.
const DIVISIONS: [&str; 4] = ["residuals", "apparatus", "coarse and screen", "fines"];
const HEADER: [&str; 5] = ["division", "place", "volume_m3", "in_bridges_m3", "share"];
/// Sides that round walls are cut into to find how high their elements lie.
const SIDES: u32 = 36;
const FRAME: &str = "frame";

/// Volume at a place with its share of the bridges, and that share, m³.
type Held = [f64; 2];

/// Writes the table of a run that has ended; nothing for a dry one.
pub(crate) fn write<T: Makeup>(
    folder: &Path,
    scene: &Scene,
    simulation: &Simulation<T, MeshWalls>,
    tally: &Tally,
) -> Result<(), RunError> {
    let Some(wet) = simulation.term().wet() else { return Ok(()) };
    let rows = rows(scene, simulation, wet, tally);
    let path = folder.join("liquid_final.csv");
    let write = || -> Result<(), csv::Error> {
        let mut file = csv::Writer::from_path(&path)?;
        file.write_record(HEADER)?;
        let all = wet.ledger().parts().initial;
        for (division, place, [volume, bridges]) in rows {
            let share = if all > 0.0 { volume / all } else { 0.0 };
            file.write_record([
                division,
                &place,
                &number(volume),
                &number(bridges),
                &number(share),
            ])?;
        }
        file.flush().map_err(csv::Error::from)
    };
    let fail = |e: csv::Error| RunError::Write {
        path: path.clone(),
        source: std::io::Error::other(e.to_string()),
    };
    write().map_err(fail)
}

/// Division, place and what is there; each division ends with its sum, the table with that of all.
fn rows<T: Makeup>(
    scene: &Scene,
    simulation: &Simulation<T, MeshWalls>,
    wet: &WetTerm,
    tally: &Tally,
) -> Vec<(&'static str, String, Held)> {
    let [residuals, apparatus, coarse, fines] = DIVISIONS;
    let class = |k: usize| scene.classes[k].name.clone();
    let mut held: Vec<(&'static str, String, Held)> = Vec::new();
    for (place, on) in walls(scene, simulation, wet, tally) {
        let screen = place == "wires" || place == "screen frame";
        held.push((if screen { coarse } else { apparatus }, place, on));
    }
    for k in 0..scene.classes.len() {
        let shared = tally.film_shared[k];
        held.push((coarse, class(k), [shared, shared - tally.film[k]]));
        held.push((fines, class(k), [tally.fines[k], 0.0]));
    }
    let sum = |of: &dyn Fn(&str) -> bool| {
        let those = held.iter().filter(|(division, _, _)| of(division));
        those.fold([0.0; 2], |a, (_, _, b)| [a[0] + b[0], a[1] + b[1]])
    };
    let known = sum(&|_| true);
    // Rounding only: what an experiment loses has no counterpart here.
    let rest = wet.ledger().parts().initial - known[0];
    let mut rows = vec![(residuals, "all".to_owned(), [rest, 0.0])];
    for division in [apparatus, coarse, fines] {
        rows.extend(held.iter().filter(|row| row.0 == division).cloned());
        rows.push((division, "all".to_owned(), sum(&|own| own == division)));
    }
    rows.push(("all", "all".to_owned(), [known[0] + rest, known[1]]));
    rows
}

/// What each kind of wall holds; the frame is feed bin above the bin's floor and screen below it.
fn walls<T: Makeup>(
    scene: &Scene,
    simulation: &Simulation<T, MeshWalls>,
    wet: &WetTerm,
    tally: &Tally,
) -> BTreeMap<String, Held> {
    let mut held: BTreeMap<String, Held> = BTreeMap::new();
    let parts = simulation.boundary().0.parts();
    for (k, part) in parts.iter().enumerate() {
        let on = [tally.parts_shared[k], tally.parts_shared[k] - tally.parts[k]];
        let split = match floor(scene).filter(|_| part.name == FRAME) {
            Some(floor) => {
                let bin = above(simulation, wet, k as u32, floor);
                vec![("feed bin", bin), ("screen frame", [on[0] - bin[0], on[1] - bin[1]])]
            }
            None if part.name == FRAME => vec![("screen frame", on)],
            None => vec![(group(&part.name), on)],
        };
        for (place, on) in split {
            let entry = held.entry(place.to_owned()).or_default();
            *entry = [entry[0] + on[0], entry[1] + on[1]];
        }
    }
    held
}

/// What a part holds higher than `floor` m above the wire axes: elements by their middle, bridges
/// by their sphere.
fn above<T: Makeup>(
    simulation: &Simulation<T, MeshWalls>,
    wet: &WetTerm,
    part: u32,
    floor: f64,
) -> Held {
    let walls = &simulation.boundary().0;
    let rise = walls.displacement(part).z;
    let surface = walls.tessellation(part, SIDES);
    let count = walls.parts()[part as usize].shape.element_count() as usize;
    let mut heights = vec![[0.0, 0.0]; count];
    for (triangle, &element) in surface.triangles.iter().zip(&surface.elements) {
        let sum: f64 = triangle.iter().map(|&v| surface.points[v as usize].z - rise).sum();
        let [height, corners] = heights[element as usize];
        heights[element as usize] = [height + sum, corners + 3.0];
    }
    let first = walls.first_element(part);
    let high = heights.iter().enumerate().filter(|(_, [sum, n])| *sum > floor * n);
    let film: f64 = high.map(|(k, _)| wet.ledger().volume(Account::Wall(first + k as u32))).sum();
    let positions: BTreeMap<u32, f64> =
        simulation.particles().iter().map(|p| (p.id, p.position.z - rise)).collect();
    let ours = wet.bridges().filter(|live| live.second == Partner::Wall(part));
    let high = ours.filter(|live| positions.get(&live.first).is_some_and(|&z| z > floor));
    let bridges: f64 = high.map(|live| live.split.shares(live.bridge.volume())[1]).sum();
    [film + bridges, bridges]
}
