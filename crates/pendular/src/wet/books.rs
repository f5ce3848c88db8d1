//! Who gives liquid to whom, and what a bridge becomes.

use pendular_capillary::CapillaryLaw;
use pendular_dem_core::{Encounter, Partner};
use pendular_lubrication::{NormalDrag, TangentialDrag};
use pendular_pair::{Bridge, Mate, OutOfRange};
use pendular_transfer::formation::{self, WetMate};
use pendular_transfer::{RuptureLaw, TransferError, film};

use super::bodies::parameter;
use super::shelf::Far;
use super::{LiveBridge, Seated, Wet, WetError};
use crate::{Account, Move, PairLaws};

/// Rupture distance and curves of a bridge by such laws.
pub(super) type CurvesOf<C, N, S> =
    Far<<C as CapillaryLaw>::Curve, <N as NormalDrag>::Curve, <S as TangentialDrag>::Curve>;

impl<C, N, S> Wet<C, N, S>
where
    C: CapillaryLaw,
    N: NormalDrag,
    S: TangentialDrag,
{
    pub(super) fn radius(&self, id: u32) -> f64 {
        self.bodies.radii[usize::from(self.bodies.class[id as usize])]
    }

    /// Wall element of an encounter, numbered through all parts.
    pub(super) fn element(&self, part: u32, encounter: &Encounter) -> usize {
        (self.bodies.first_elements[part as usize] + encounter.element) as usize
    }

    pub(super) fn thicknesses(&self, encounter: &Encounter) -> [f64; 2] {
        let second = match encounter.second {
            Partner::Particle(id) => self.thickness[id as usize],
            Partner::Wall(part) => self.wall_thickness[self.element(part, encounter)],
        };
        [self.thickness[encounter.first as usize], second]
    }

    pub(super) fn accounts(&self, encounter: &Encounter) -> [Account; 2] {
        let second = match encounter.second {
            Partner::Particle(id) => Account::Film(id),
            Partner::Wall(part) => Account::Wall(self.element(part, encounter) as u32),
        };
        [Account::Film(encounter.first), second]
    }

    pub(super) fn mate(&self, encounter: &Encounter) -> WetMate {
        match encounter.second {
            Partner::Particle(id) => WetMate::Sphere {
                radius: self.radius(id),
                film_volume: self.ledger.volume(Account::Film(id)),
            },
            Partner::Wall(part) => {
                let element = self.element(part, encounter);
                WetMate::Wall {
                    half_side: self.bodies.half_sides[part as usize],
                    film_volume: self.ledger.volume(Account::Wall(element as u32)),
                    area: self.bodies.elements[element].area,
                }
            }
        }
    }

    /// Smallest volume of a bridge, m³.
    pub(super) fn smallest(&self, encounter: &Encounter) -> f64 {
        let radius = self.radius(encounter.first);
        let reduced = match encounter.second {
            Partner::Particle(id) => radius * self.radius(id) / (radius + self.radius(id)),
            Partner::Wall(_) => radius,
        };
        // The volume is positive also where the ratio's smallest value is set to 0.
        (self.smallest_v_star * (2.0 * reduced).powi(3)).max(f64::MIN_POSITIVE)
    }

    pub(super) fn contact_angles(&self, first: u32, second: Partner) -> [f64; 2] {
        let of = |id: u32| {
            let class = usize::from(self.bodies.class[id as usize]);
            self.liquid.particle_angles[usize::from(self.bodies.materials[class])]
        };
        let second = match second {
            Partner::Particle(id) => of(id),
            Partner::Wall(part) => {
                self.liquid.wall_angles[usize::from(self.bodies.wall_materials[part as usize])]
            }
        };
        [of(first), second]
    }

    /// What both bodies would give to a new bridge.
    pub(super) fn claims(
        &self,
        encounter: &Encounter,
        bridge: u32,
    ) -> Result<[Move; 2], TransferError> {
        let film = self.ledger.volume(Account::Film(encounter.first));
        let mate = self.mate(encounter);
        let claims = formation::claims(self.radius(encounter.first), film, mate)?;
        let [first, second] = self.accounts(encounter);
        let to = Account::Bridge(bridge);
        Ok([
            Move { from: first, to, volume: claims[0] },
            Move { from: second, to, volume: claims[1] },
        ])
    }

    /// Whether there is enough in an account for a bridge.
    pub(super) fn has_enough(&self, account: u32, encounter: &Encounter) -> bool {
        self.ledger.volume(Account::Bridge(account)) >= self.smallest(encounter)
    }

    /// Folds a bridge, now that its volume is known, and puts what acts in it on the shelf.
    pub(super) fn fold(
        &mut self,
        account: u32,
        seat: u32,
        &Encounter { first, second, .. }: &Encounter,
    ) -> Result<(), WetError> {
        let volume = self.ledger.volume(Account::Bridge(account));
        let refuse = |source| WetError::Law { first, second, volume, source };
        let bridge = self.bridge(first, second, volume).map_err(refuse)?;
        let split = self.splits.of(&bridge);
        let (split, extrapolated) =
            split.map_err(|source| WetError::Transfer { first, second, volume, source })?;
        let live = LiveBridge { bridge, split, first, second };
        let far = self.curves(&live).map_err(refuse)?;
        let laws = self.laws(second);
        let strange = laws.capillary.validity().check(&bridge).is_err()
            || laws.rupture.validity_of(&bridge).check(&bridge).is_err();
        self.counts.extrapolated += u64::from(strange || extrapolated);
        self.shelf.put(seat, far);
        self.live[account as usize] = Some(Seated { split, first, second, seat });
        Ok(())
    }

    /// A bridge of a volume between two bodies.
    pub(super) fn bridge(
        &self,
        first: u32,
        second: Partner,
        volume: f64,
    ) -> Result<Bridge, OutOfRange> {
        let mate = match second {
            Partner::Particle(id) => Mate::Sphere { radius: self.radius(id) },
            Partner::Wall(part) => Mate::Wall { half_side: self.bodies.half_sides[part as usize] },
        };
        let angles = self.contact_angles(first, second);
        Bridge::new(self.radius(first), mate, volume, angles, self.liquid.surface_tension)
    }

    /// The laws of the bridges with a body.
    pub(super) fn laws(&self, second: Partner) -> &PairLaws<C, N, S> {
        match second {
            Partner::Particle(_) => &self.between,
            Partner::Wall(_) => &self.with_walls,
        }
    }

    /// What acts in a bridge.
    pub(super) fn curves(&self, live: &LiveBridge) -> Result<CurvesOf<C, N, S>, OutOfRange> {
        let (laws, bridge) = (self.laws(live.second), &live.bridge);
        let viscosity = self.liquid.viscosity;
        Ok(Far {
            rupture: laws.rupture.distance(bridge, self.range)?,
            curves: (
                laws.capillary.curve(bridge, self.range)?,
                laws.normal.curve(bridge, viscosity)?,
                laws.tangential.curve(bridge, viscosity)?,
            ),
        })
    }

    /// Brings the film thickness of an account up to date.
    pub(super) fn measure(&mut self, account: Account) -> Result<(), WetError> {
        let volume = self.ledger.volume(account);
        let thickness = match account {
            Account::Film(id) => {
                let h = film::thickness(self.radius(id), volume).map_err(parameter)?;
                self.thickness[id as usize] = h;
                h
            }
            Account::Wall(element) => {
                let area = self.bodies.elements[element as usize].area;
                let h = film::wall_thickness(area, volume).map_err(parameter)?;
                self.wall_thickness[element as usize] = h;
                h
            }
            Account::Bridge(_) | Account::Drained => 0.0,
        };
        self.thickest = self.thickest.max(thickness);
        Ok(())
    }

    /// Moves that end a bridge: its volume goes back to its bodies in the split's shares.
    pub(super) fn rupture(&mut self, encounter: &Encounter, bridge: u32) -> [Move; 2] {
        let [to_first, to_second] = self.accounts(encounter);
        let [first, second] = self.shares(bridge);
        let from = Account::Bridge(bridge);
        [Move { from, to: to_first, volume: first }, Move { from, to: to_second, volume: second }]
    }
}
