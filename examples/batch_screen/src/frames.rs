//! What ParaView is shown of a moment.

use pendular::MeshWalls;
use pendular::dem::{DVec3, Particle, Partner, Simulation, Touch};
use pendular::walls::Walls;
use pendular::{Account, LiveBridge};

use crate::build::WetTerm;
use crate::makeup::Makeup;
use crate::vtk::{BridgeRow, Frame, ParticleRow, WallMesh};

/// Sides that round walls are drawn with.
const SIDES: u32 = 12;

/// One moment of a simulation.
pub(crate) fn frame<T: Makeup>(simulation: &Simulation<T, MeshWalls>) -> Frame {
    let classes = simulation.particles().classes();
    let wet = simulation.term().wet();
    let mut particles: Vec<Particle> = simulation.particles().iter().collect();
    particles.sort_by_key(|particle| particle.id);
    let row = |p: &Particle| ParticleRow {
        id: p.id.into(),
        class: p.class.into(),
        position: p.position.to_array(),
        radius: classes[usize::from(p.class)].radius(),
        velocity: p.velocity.to_array(),
        film: wet.map_or(0.0, |wet| wet.film_thickness(p.id)),
    };
    let walls = &simulation.boundary().0;
    Frame {
        time: simulation.time(),
        particles: particles.iter().map(row).collect(),
        bridges: wet.map_or_else(Vec::new, |wet| bridges(wet, simulation, &particles)),
        walls: mesh(walls, wet),
    }
}

fn bridges<T: Makeup>(
    wet: &WetTerm,
    simulation: &Simulation<T, MeshWalls>,
    particles: &[Particle],
) -> Vec<BridgeRow> {
    let find =
        |id: u32| particles.binary_search_by_key(&id, |p| p.id).ok().map(|k| particles[k].position);
    let row = |live: LiveBridge| {
        let x = find(live.first)?;
        let (end, gap) = match live.second {
            Partner::Particle(id) => {
                let y = find(id)?;
                (y, (y - x).length() - live.bridge.radius() - live.bridge.mate().radius())
            }
            Partner::Wall(part) => on_wall(&simulation.boundary().0, part, x, &live.bridge)?,
        };
        let force = wet.tension(&live, gap).unwrap_or(0.0);
        let ends = [x.to_array(), end.to_array()];
        Some(BridgeRow { ends, volume: live.bridge.volume(), force, gap })
    };
    wet.bridges().filter_map(row).collect()
}

/// Nearest point of a wall part, and the gap.
fn on_wall(
    walls: &Walls,
    part: u32,
    x: DVec3,
    bridge: &pendular::pair::Bridge,
) -> Option<(DVec3, f64)> {
    let (mut elements, mut touches) = (Vec::new(), Vec::new());
    // A bridge reaches no farther than the sphere's own diameter.
    walls.candidates(part, x, 3.0 * bridge.radius(), &mut elements);
    walls.touches(part, &elements, x, bridge.radius(), f64::INFINITY, &mut touches);
    let touch = touches.first().map(|t| Touch { element: t.element, gap: t.gap, normal: t.normal });
    touch.map(|t| (x + t.normal * (bridge.radius() + t.gap), t.gap))
}

fn mesh(walls: &Walls, wet: Option<&WetTerm>) -> WallMesh {
    let mut all = WallMesh::default();
    for part in 0..walls.parts().len() as u32 {
        if !walls.is_present(part) {
            continue;
        }
        let shape = &walls.parts()[part as usize].shape;
        let surface = walls.tessellation(part, SIDES);
        let first = all.points.len() as u32;
        all.points.extend(surface.points.iter().map(|p| p.to_array()));
        all.triangles.extend(surface.triangles.iter().map(|t| t.map(|v| v + first)));
        all.film.extend(surface.elements.iter().map(|&element| {
            let area = shape.element_area(element).unwrap_or(f64::INFINITY);
            let account = Account::Wall(walls.first_element(part) + element);
            wet.map_or(0.0, |wet| wet.ledger().volume(account)) / area
        }));
    }
    all
}
