//! The read half between particles and walls, and the lists it works on.

use std::time::Instant;

use glam::DVec3;

use crate::chunk::{Chunk, List, Memories, Memory, Note, WallPair};
use crate::particles::Place;
use crate::pass::{add_wall, roll};
use crate::view::View;
use crate::{Boundary, Encounter, Pair, PairTerm, Partner, Touch};

/// Two touches of one part whose normals differ by less than this cosine are the same touch.
const SAME: f64 = 0.8;

/// Loads all wall pairs of a chunk.
pub(crate) fn read<T: PairTerm, B: Boundary>(
    view: &View<'_>,
    term: &T,
    boundary: &B,
    chunk: &mut Chunk<T::Column>,
) {
    if chunk.walls.is_empty() {
        return;
    }
    let start = Instant::now();
    let reach = term.reach();
    let mut walls = std::mem::take(&mut chunk.walls);
    for (index, wall) in walls.iter_mut().enumerate() {
        if boundary.is_present(wall.part) {
            one(view, term, boundary, chunk, wall, index as u32, reach);
        }
    }
    chunk.walls = walls;
    chunk.wall_time += start.elapsed();
}

#[inline]
fn one<T: PairTerm, B: Boundary>(
    view: &View<'_>,
    term: &T,
    boundary: &B,
    chunk: &mut Chunk<T::Column>,
    wall: &mut WallPair<T::Column>,
    index: u32,
    reach: f64,
) {
    let Place { x, r } = view.places[wall.slot as usize];
    let live = wall.memories.iter().any(|m| term.live(&m.column));
    if let Some(touch) = boundary.single_touch(wall.part, x, r) {
        let near = touch.gap <= reach;
        if !live && !near {
            wall.memories.clear();
            return;
        }
        let same = |m: &Memory<T::Column>| m.touch.normal.dot(touch.normal) >= SAME;
        if wall.memories.is_empty() {
            wall.memories.push(Memory { touch, column: T::Column::default() });
        }
        if wall.memories.len() == 1 && same(&wall.memories[0]) {
            act(view, term, boundary, chunk, wall, index, 0, &touch);
            return;
        }
    }
    let reach = if live { f64::INFINITY } else { reach };
    let candidates = &chunk.pool[wall.candidates.clone()];
    boundary.touches(wall.part, candidates, x, r, reach, &mut chunk.touches);
    if !chunk.touches.iter().any(|t| t.gap <= reach) {
        // A live pair is kept until the term lets go of it, also where no touch is found.
        if !live {
            wall.memories.clear();
        }
        return;
    }
    remember(term, &chunk.touches, &mut wall.memories, &mut chunk.memories);
    let touches = std::mem::take(&mut chunk.touches);
    for (k, touch) in touches.iter().enumerate() {
        act(view, term, boundary, chunk, wall, index, k, touch);
    }
    chunk.touches = touches;
}

/// Loads one touch, the `k`-th nearest of its part.
#[inline(always)]
#[allow(clippy::too_many_arguments)] // one loop body in two places
fn act<T: PairTerm, B: Boundary>(
    view: &View<'_>,
    term: &T,
    boundary: &B,
    chunk: &mut Chunk<T::Column>,
    wall: &mut WallPair<T::Column>,
    index: u32,
    k: usize,
    touch: &Touch,
) {
    let memory = &mut wall.memories[k];
    let before = std::mem::replace(&mut memory.touch, *touch).normal;
    let encounter = Encounter {
        first: view.id[wall.slot as usize],
        second: Partner::Wall(wall.part),
        element: touch.element,
        nearest: k == 0,
        gap: touch.gap,
    };
    if term.idle(&encounter, &mut memory.column) {
        return;
    }
    let pair = pair(view, boundary, wall.slot, encounter, touch, before);
    let load = term.load(&pair, &mut memory.column);
    let slot = (wall.slot - chunk.range.start) as usize;
    add_wall(&mut chunk.sums[slot], &load, &pair);
    if T::IMPLICIT && !load.attention {
        let place = (List::Wall { memory: k as u16 }, index);
        chunk.links.meet(view, term, &pair, [wall.slot; 2], place, &mut memory.column);
    }
    if view.rolls() && touch.gap < 0.0 {
        roll(&mut chunk.rolls[slot], load.rolling);
    }
    if -touch.gap > chunk.overlap * pair.radii[0] {
        chunk.overlap = -touch.gap / pair.radii[0];
    }
    if load.attention {
        chunk.notes.push(Note { list: List::Wall { memory: k as u16 }, index });
    }
}

/// Gives each touch the memory of the old touch with the nearest normal, so that nothing is felt
/// where one triangle ends and the next begins; what belongs to the part goes to the nearest one.
fn remember<T: PairTerm>(
    term: &T,
    touches: &[Touch],
    memories: &mut Memories<T::Column>,
    scratch: &mut Memories<T::Column>,
) {
    scratch.clear();
    for touch in touches {
        let likeness = |m: &Memory<T::Column>| m.touch.normal.dot(touch.normal);
        let best = (0..memories.len())
            .filter(|&k| likeness(&memories[k]) >= SAME)
            .max_by(|&a, &b| likeness(&memories[a]).total_cmp(&likeness(&memories[b])));
        scratch.push(match best {
            Some(k) => memories.swap_remove(k),
            None => Memory { touch: *touch, column: T::Column::default() },
        });
    }
    if let Some((nearest, others)) = scratch.split_first_mut() {
        for other in others.iter_mut().chain(memories.iter_mut()) {
            term.hand_on(&mut other.column, &mut nearest.column);
        }
    }
    std::mem::swap(memories, scratch);
}

/// A particle and a wall. The half-step normal is the mean of the last two: right on any shape.
#[inline(always)]
pub(crate) fn pair<B: Boundary>(
    view: &View<'_>,
    boundary: &B,
    slot: u32,
    encounter: Encounter,
    touch: &Touch,
    before: DVec3,
) -> Pair {
    let Partner::Wall(part) = encounter.second else { unreachable!("a wall pair") };
    let slot = slot as usize;
    let r = view.places[slot].r;
    let v = &view.velocities[slot];
    let (spin, velocity) = (v.w.vector(), v.v.vector() - boundary.velocity(part));
    let half_step_normal =
        if before == touch.normal { touch.normal } else { (before + touch.normal).normalize() };
    let along = velocity.dot(half_step_normal);
    let mut pair = Pair {
        encounter,
        first_class: view.class[slot],
        second_class: u16::from(boundary.material(part)),
        radii: [r, f64::INFINITY],
        normal: touch.normal,
        half_step_normal,
        separation_speed: -along,
        slip: velocity - along * half_step_normal + (r * spin).cross(half_step_normal),
        spin,
        expected_spin: DVec3::ZERO,
        rolling_inertia: 0.0,
        levers: [r, 0.0],
        time_step: view.time_step,
    };
    if view.rolls() {
        let roll = &view.rolls[slot];
        pair.expected_spin = spin + roll.spin;
        pair.rolling_inertia = view.inertia(slot) / roll.contacts;
    }
    pair
}

/// A particle and a wall part at a touch, as they were last read.
pub(crate) fn meeting(view: &View<'_>, wall: &WallPair<impl Copy>, touch: &Touch) -> Encounter {
    Encounter {
        first: view.id[wall.slot as usize],
        second: Partner::Wall(wall.part),
        element: touch.element,
        nearest: true,
        gap: touch.gap,
    }
}

/// Renews a chunk's wall pairs: every part within `reach`, and every live pair at its own gap.
pub(crate) fn find<T: PairTerm, B: Boundary>(
    term: &T,
    boundary: &B,
    places: &[Place],
    reach: f64,
    chunk: &mut Chunk<T::Column>,
) {
    let mut carried = std::mem::take(&mut chunk.walls).into_iter().peekable();
    chunk.pool.clear();
    let (mut parts, mut candidates, mut mine) = (Vec::new(), Vec::new(), Vec::new());
    for slot in chunk.range.clone() {
        let Place { x, r } = places[slot as usize];
        boundary.near(x, r + reach, &mut parts);
        mine.clear();
        while let Some(wall) = carried.next_if(|wall| wall.slot == slot) {
            if wall.memories.iter().any(|m| term.live(&m.column)) && !parts.contains(&wall.part) {
                parts.push(wall.part);
            }
            mine.push(wall);
        }
        parts.sort_unstable();
        for &part in &parts {
            let old = mine.iter_mut().find(|wall| wall.part == part);
            let memories = old.map(|wall| std::mem::take(&mut wall.memories)).unwrap_or_default();
            let live = memories.iter().filter(|m| term.live(&m.column));
            // A live pair's gap has changed by less than the skin since it was read.
            let apart = live.fold(0.0_f64, |most, m| most.max(m.touch.gap + reach));
            let may_touch = boundary.candidates(part, x, r + reach + apart, &mut candidates);
            if may_touch || !memories.is_empty() {
                let start = chunk.pool.len();
                chunk.pool.extend_from_slice(&candidates);
                let candidates = start..chunk.pool.len();
                chunk.walls.push(WallPair { slot, part, candidates, memories });
            }
        }
    }
    chunk.walls.shrink_to_fit();
    chunk.pool.shrink_to_fit();
}
