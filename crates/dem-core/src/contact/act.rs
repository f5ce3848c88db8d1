//! The forces of a contact, of one pair or of several side by side.

use glam::DVec3;
use pendular_contact::NormalContact;

use super::{PairContact, Spring};
use crate::lane::{Lane, Vector};
use crate::pairs::{Columns, Geometry, Loads};

/// Which parts of a contact are loads; the others are solved for at the end of the step.
#[derive(Clone, Copy)]
pub(super) struct Acting {
    pub(super) rolls: bool,
    pub(super) dashpot: bool,
}

/// What acts in pairs side by side; nothing in those that do not touch.
#[inline(always)]
pub(super) fn act<L: Lane, N: NormalContact>(
    permit: L::Permit,
    laws: L::Each<&PairContact<N>>,
    acting: Acting,
    pairs: &Geometry<L>,
    columns: &mut impl Columns<Spring<N::Memory>>,
) -> Loads<L> {
    let approach = if acting.dashpot { -pairs.separation_speed } else { L::splat(permit, 0.0) };
    let springs = L::each(|k| *columns.column(k));
    let normal = L::each(|k| &laws[k].normal);
    let mut memories = L::each(|k| springs[k].memory);
    let [repulsion, stiffness, softness] =
        N::side_by_side(&normal, -pairs.gap, approach, &mut memories);
    let zero = L::splat(permit, 0.0);
    let repulsion = pairs.gap.if_less(zero, repulsion, zero);
    let [x, y, z, _] = L::rows(permit, &springs, |s| [s.stretch.x, s.stretch.y, s.stretch.z, 0.0]);
    let elastic = [stiffness, softness];
    let (shear, stretch) = tangential(&laws, pairs, repulsion, elastic, Vector { x, y, z });
    let stretch = stretch.rows(permit);
    for k in 0..L::WIDTH {
        let [x, y, z, _] = stretch[k];
        let memory = memories[k];
        *columns.column(k) = Spring { stretch: DVec3 { x, y, z }, memory };
    }
    let rolling = if acting.rolls {
        rolling(L::pack(permit, &laws, |law| law.rolling_friction) * repulsion.most(zero), pairs)
    } else {
        Vector::zero(permit)
    };
    Loads { tension: -repulsion, shear, rolling, ..Loads::none(permit) }
}

/// F_t = −k_t ξ − γ_t u, at most μ |F_n|; ξ follows the slip and the turning contact plane.
///
/// Returns force and ξ; both are zero where the bodies do not touch.
#[inline(always)]
fn tangential<L: Lane, N: NormalContact>(
    laws: &L::Each<&PairContact<N>>,
    pairs: &Geometry<L>,
    repulsion: L,
    [stiffness, softness]: [L; 2],
    stretch: Vector<L>,
) -> (Vector<L>, Vector<L>) {
    let permit = pairs.gap.permit();
    let (half, normal, slip) = (pairs.half_step_normal, pairs.normal, pairs.slip);
    let before = stretch - half * stretch.dot(half) + slip * L::splat(permit, pairs.time_step);
    let now = before - normal * before.dot(normal);
    let dashpot = slip * L::pack(permit, laws, |law| law.tangential_damping);
    let trial = -(now * stiffness) - dashpot;
    let limit = L::pack(permit, laws, |law| law.friction) * repulsion.most(-repulsion);
    let (zero, one) = (L::splat(permit, 0.0), L::splat(permit, 1.0));
    // No force at all gives 0/0 or a huge number: both are no sliding.
    let share = limit / trial.dot(trial).sqrt();
    let force = trial * share.least(one);
    let slid = -((force + dashpot) * softness);
    let stretch = Vector::if_less(share, one, slid, now);
    let none = Vector::zero(permit);
    let touching = |v| Vector::if_less(pairs.gap, zero, v, none);
    (touching(force), touching(stretch))
}

/// The torque that would stop the expected relative rolling in this step, at most `limit` (N m).
#[inline(always)]
fn rolling<L: Lane>(limit: L, pairs: &Geometry<L>) -> Vector<L> {
    let permit = pairs.gap.permit();
    let (spin, normal) = (pairs.expected_spin, pairs.normal);
    let rolling = spin - normal * spin.dot(normal);
    let stopping = -(rolling * (pairs.rolling_inertia / L::splat(permit, pairs.time_step)));
    let share = limit / stopping.dot(stopping).sqrt();
    stopping * share.least(L::splat(permit, 1.0))
}
