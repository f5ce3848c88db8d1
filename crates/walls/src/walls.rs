use std::collections::HashSet;

use glam::DVec3;

use crate::bounds::Tree;
use crate::touch::Touch;
use crate::{Motion, Part, Shape, Tessellation, WallError};

/// All wall parts, at one moment.
///
/// [`Walls::move_to`] sets the moment; all queries are `&self` and may run in parallel. Parts are
/// numbered from 0 in the order given; a part that has been taken away keeps its number.
///
/// Three levels of search, each cheaper to repeat than the one before: [`Walls::near`] for the
/// parts around a sphere, [`Walls::candidates`] for the triangles of one part, both with room to
/// spare so that they are asked for now and then only, and [`Walls::touches`] at every step.
#[derive(Debug, Clone)]
pub struct Walls {
    parts: Vec<Part>,
    /// The motions that differ, and for each part which is its own.
    motions: Vec<Motion>,
    motion_of: Vec<u32>,
    /// Boxes of all parts but planes, over their whole way.
    tree: Tree,
    planes: Vec<u32>,
    /// Per motion, at the present moment.
    displacements: Vec<DVec3>,
    velocities: Vec<DVec3>,
    time: f64,
    speed_bound: f64,
    /// First element of each part when all elements are numbered through, and their number.
    offsets: Vec<u32>,
}

impl Walls {
    /// Puts parts together, at time 0.
    ///
    /// # Errors
    /// [`WallError::DuplicateName`], and [`WallError::OutOfRange`] for a motion with a number that
    /// is not finite, a half side that is not positive, or a NaN time of removal.
    pub fn new(parts: Vec<Part>) -> Result<Self, WallError> {
        let mut names = HashSet::new();
        let (mut motions, mut motion_of) = (Vec::<Motion>::new(), Vec::new());
        let mut offsets = vec![0u32];
        for part in &parts {
            part.check()?;
            if !names.insert(part.name.as_str()) {
                return Err(WallError::DuplicateName { name: part.name.clone() });
            }
            let known = motions.iter().position(|m| *m == part.motion);
            motion_of.push(known.unwrap_or(motions.len()) as u32);
            if known.is_none() {
                motions.push(part.motion.clone());
            }
            let first = offsets[offsets.len() - 1];
            let end = f64::from(first) + f64::from(part.shape.element_count());
            let allowed = (0.0, f64::from(u32::MAX));
            WallError::within(&part.name, "number of all elements", end, allowed)?;
            offsets.push(first + part.shape.element_count());
        }
        let boxes = parts.iter().enumerate().filter_map(|(k, part)| {
            Some((k, part.shape.bounds()?.enlarged(part.motion.amplitude_bound())))
        });
        let tree = Tree::new(boxes);
        let is_plane = |k: &u32| matches!(parts[*k as usize].shape, Shape::Plane(_));
        let planes = (0..parts.len() as u32).filter(is_plane).collect();
        let speed_bound = motions.iter().map(Motion::speed_bound).fold(0.0, f64::max);
        let still = vec![DVec3::ZERO; motions.len()];
        let mut walls = Self {
            parts,
            motions,
            motion_of,
            tree,
            planes,
            displacements: still.clone(),
            velocities: still,
            time: 0.0,
            speed_bound,
            offsets,
        };
        walls.move_to(0.0, 0.0);
        Ok(walls)
    }

    /// The parts, in their rest positions.
    #[must_use]
    pub fn parts(&self) -> &[Part] {
        &self.parts
    }

    /// Moves all parts to their positions at `time` and gives them their velocities at
    /// `velocity_time` (s); a leapfrog scheme has the velocities half a step apart.
    ///
    /// Presence follows `time`. Both must be finite: NaN makes every query come back empty.
    pub fn move_to(&mut self, time: f64, velocity_time: f64) {
        self.time = time;
        for (k, motion) in self.motions.iter().enumerate() {
            self.displacements[k] = motion.displacement(time);
            self.velocities[k] = motion.velocity(velocity_time);
        }
    }

    /// Time of the present positions, s.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Displacement of a part from its rest position, m.
    ///
    /// # Panics
    /// Where there is no such part.
    #[must_use]
    #[inline]
    pub fn displacement(&self, part: u32) -> DVec3 {
        self.displacements[self.motion_of[part as usize] as usize]
    }

    /// Velocity of a part, m/s.
    ///
    /// # Panics
    /// Where there is no such part.
    #[must_use]
    #[inline]
    pub fn velocity(&self, part: u32) -> DVec3 {
        self.velocities[self.motion_of[part as usize] as usize]
    }

    /// Whether a part is there at the present time: `time < present_until`.
    ///
    /// # Panics
    /// Where there is no such part.
    #[must_use]
    #[inline]
    pub fn is_present(&self, part: u32) -> bool {
        self.time < self.parts[part as usize].present_until
    }

    /// Upper bound of the speed of any part at any time, m/s.
    #[must_use]
    pub fn speed_bound(&self) -> f64 {
        self.speed_bound
    }

    /// Number of elements of all parts together.
    #[must_use]
    pub fn element_total(&self) -> u32 {
        self.offsets[self.parts.len()]
    }

    /// Number of a part's first element when the elements of all parts are numbered through
    /// in the order of the parts.
    ///
    /// # Panics
    /// Where there is no such part.
    #[must_use]
    pub fn first_element(&self, part: u32) -> u32 {
        self.offsets[..self.parts.len()][part as usize]
    }

    /// Collects the parts that may have a point within `reach` (m) of `centre`, ascending; `out`
    /// is cleared first. No part is missed; a mesh is judged by its box.
    pub fn near(&self, centre: DVec3, reach: f64, out: &mut Vec<u32>) {
        out.clear();
        let may_reach = |part: u32| {
            let point = centre - self.displacement(part);
            self.is_present(part) && self.parts[part as usize].shape.may_reach(point, reach)
        };
        self.tree.near(centre, reach, |part| {
            if may_reach(part) {
                out.push(part);
            }
        });
        out.extend(self.planes.iter().filter(|part| may_reach(**part)));
        out.sort_unstable();
    }

    /// Collects the triangles of a mesh part within `reach` (m) of `centre`, ascending; `out`
    /// is cleared first. Nothing for the other shapes, which need none.
    ///
    /// As long as sphere and part have moved by less than `skin` against each other, a sphere
    /// of radius r has all its touches with gap <= g among the candidates of reach r + g +
    /// `skin`.
    ///
    /// # Panics
    /// Where there is no such part.
    pub fn candidates(&self, part: u32, centre: DVec3, reach: f64, out: &mut Vec<u32>) {
        let point = centre - self.displacement(part);
        self.parts[part as usize].shape.candidates(point, reach, out);
    }

    /// Collects the touches of a sphere with a part whose gap is at most `reach` (m), nearest
    /// first; `out` is cleared first. Empty for a part that has been taken away.
    ///
    /// `candidates` must hold all triangles within radius + `reach`, as [`Walls::candidates`]
    /// gives them (more do no harm): an edge is looked at by one of its triangles only.
    ///
    /// A plane, a wire and a frame give at most one touch, a mesh one for each face, ridge or
    /// corner of those among `candidates` that the sphere touches on its own.
    ///
    /// # Panics
    /// Where there is no such part or no such candidate.
    pub fn touches(
        &self,
        part: u32,
        candidates: &[u32],
        centre: DVec3,
        radius: f64,
        reach: f64,
        out: &mut Vec<Touch>,
    ) {
        out.clear();
        if self.is_present(part) {
            let point = centre - self.displacement(part);
            let shape = &self.parts[part as usize].shape;
            shape.touches(candidates, point, radius, reach, out);
        }
    }

    /// The one place where a sphere can touch a `part` that is a plane, a wire or a frame, whatever
    /// the gap and without asking whether the part is there; `None` for a mesh.
    #[must_use]
    #[inline]
    pub fn single_touch(&self, part: u32, centre: DVec3, radius: f64) -> Option<Touch> {
        let point = centre - self.displacement(part);
        self.parts[part as usize].shape.single_touch(point, radius)
    }

    /// Triangles for drawing a part where it is now; `sides` is the number of sides of a
    /// cylinder.
    ///
    /// # Panics
    /// Where there is no such part.
    #[must_use]
    pub fn tessellation(&self, part: u32, sides: u32) -> Tessellation {
        let mut mesh = self.parts[part as usize].shape.tessellation(sides);
        let shift = self.displacement(part);
        mesh.points.iter_mut().for_each(|p| *p += shift);
        mesh
    }
}
