//! What bridges between like bodies have in common, kept once for all of them.

use std::collections::HashMap;

use pendular_lubrication::{Resistance, TangentialCurve};

use super::act::Pull;

/// What the drag across the line of centres and the fade in overlap are made of: with all laws there
/// are, both follow from the bodies alone and not from the volume.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Kind<S> {
    pub(super) tangential: S,
    /// Slip resistance at contact, N s/m. In overlap drags fade by exp of the other number, 1/m,
    /// times the gap; it is negative where the curves have to be asked.
    pub(super) contact: [f64; 2],
    /// Coupling and rolling resistance at contact, N s/m.
    pub(super) turning: [f64; 2],
}

impl<S: TangentialCurve> Kind<S> {
    /// The kind of a bridge with forces at `contact`, or none that say anything of overlap.
    pub(super) fn new(tangential: S, contact: Option<&Pull>) -> Self {
        let Resistance { slip, coupling, rolling } = tangential.resistance(0.0);
        let fade = contact.map_or(-1.0, Pull::fade);
        Self { tangential, contact: [slip, fade], turning: [coupling, rolling] }
    }
}

/// All kinds by their numbers. Equal ones have one number unless, by chance, others with the same
/// forces at contact come between.
pub(super) struct Kinds<S> {
    all: Vec<Kind<S>>,
    /// The last kind of each key.
    last: HashMap<[u64; 2], u32>,
    /// Whether any resists more than slip.
    pub(super) turn: bool,
}

impl<S> Default for Kinds<S> {
    fn default() -> Self {
        Self { all: Vec::new(), last: HashMap::new(), turn: false }
    }
}

impl<S: TangentialCurve> Kinds<S> {
    /// The number of a kind.
    pub(super) fn number(&mut self, kind: Kind<S>) -> u32 {
        let last = self.last.entry(kind.contact.map(f64::to_bits)).or_insert(u32::MAX);
        if self.all.get(*last as usize) != Some(&kind) {
            *last = self.all.len() as u32;
            self.all.push(kind);
            self.turn |= kind.turning != [0.0; 2];
        }
        *last
    }

    #[inline(always)]
    pub(super) fn get(&self, number: u32) -> Option<&Kind<S>> {
        self.all.get(number as usize)
    }

    /// Forgets all kinds but those in use and gives these new numbers.
    pub(super) fn keep(&mut self, used: &mut [u32]) {
        let old = std::mem::take(self);
        let mut new = vec![u32::MAX; old.all.len()];
        for number in used {
            let new = &mut new[*number as usize];
            if *new == u32::MAX {
                *new = self.number(old.all[*number as usize]);
            }
            *number = *new;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pendular_lubrication::{Popov2010, TangentialDrag};
    use pendular_pair::{Bridge, Mate};

    /// The kind of a bridge between a sphere and one of 2 mm.
    fn kind(radius: f64, volume: f64) -> Kind<<Popov2010 as TangentialDrag>::Curve> {
        let mate = Mate::Sphere { radius: 2e-3 };
        let bridge = Bridge::new(radius, mate, volume, [0.1; 2], 0.07).unwrap();
        Kind::new(Popov2010::default().curve(&bridge, 1e-3).unwrap(), None)
    }

    #[test]
    fn bridges_between_like_bodies_are_of_one_kind() {
        let mut kinds = Kinds::default();
        let numbers = [(1e-3, 1e-12), (3e-3, 1e-12), (1e-3, 5e-12), (3e-3, 2e-12)]
            .map(|(radius, volume)| kinds.number(kind(radius, volume)));
        assert_eq!(numbers, [0, 1, 0, 1]);
    }

    #[test]
    fn those_in_use_are_kept_under_new_numbers() {
        let mut kinds = Kinds::default();
        let all = [1e-3, 2e-3, 3e-3].map(|radius| kind(radius, 1e-12));
        let mut used = all.map(|kind| kinds.number(kind))[1..].to_vec();
        used.push(used[0]);
        kinds.keep(&mut used);
        assert_eq!(used, [0, 1, 0]);
        assert!(kinds.get(0) == Some(&all[1]) && kinds.get(1) == Some(&all[2]));
        assert!(kinds.get(2).is_none());
        assert_eq!(kinds.number(all[0]), 2);
    }
}
