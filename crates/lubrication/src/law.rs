use pendular_lane::Lane;
use pendular_pair::{Bridge, OutOfRange};

/// A model of the viscous force along the line of centres.
pub trait NormalDrag {
    /// The drag coefficient over the gap of one bridge.
    type Curve: NormalCurve;

    /// Folds a bridge and the liquid's `viscosity` η (Pa s) into its drag curve.
    ///
    /// # Errors
    /// [`OutOfRange`] unless the viscosity is positive and finite.
    fn curve(&self, bridge: &Bridge, viscosity: f64) -> Result<Self::Curve, OutOfRange>;
}

/// The normal drag coefficient of one bridge as a function of the gap alone.
pub trait NormalCurve: Copy {
    /// Drag coefficient c_n, N s/m, at least 0 and finite for every `gap` (m, overlap negative):
    /// the force on the pair is −c_n dS/dt along the line of centres.
    fn coefficient(&self, gap: f64) -> f64;

    /// The coefficients of bridges side by side: to the bit what [`NormalCurve::coefficient`] gives
    /// for each.
    #[inline(always)]
    fn coefficients<L: Lane>(curves: &L::Each<&Self>, gap: L) -> L {
        let gaps = gap.unpack();
        L::pack(gap.permit(), &L::each(|k| curves[k].coefficient(gaps[k])), |c| *c)
    }

    /// The inverse length κ, 1/m, if in overlap the coefficient is `coefficient(0) exp(κ S)`, to
    /// rounding; 0 for a constant, infinite for none. `None` if it is anything else.
    fn fade(&self) -> Option<f64> {
        None
    }

    /// The clearance at `gap`, m, over which the coefficient changes by its own size: whoever moves
    /// the bodies by much less takes it as constant. 0, the default, where that is not known.
    fn clearance(&self, gap: f64) -> f64 {
        let _ = gap;
        0.0
    }

    /// The clearances of bridges side by side: to the bit what [`NormalCurve::clearance`] gives for
    /// each.
    #[inline(always)]
    fn clearances<L: Lane>(curves: &L::Each<&Self>, gap: L) -> L {
        let gaps = gap.unpack();
        L::pack(gap.permit(), &L::each(|k| curves[k].clearance(gaps[k])), |c| *c)
    }

    /// G(S) = ∫ c_n dS from gap 0 to `gap`, N s: the impulse that a slow change of the gap costs.
    fn impulse(&self, gap: f64) -> f64;

    /// G (N s) and c_n (N s/m) at `gap` m, for whoever wants both; c_n to rounding of that at contact.
    #[inline]
    fn charge(&self, gap: f64) -> [f64; 2] {
        [self.impulse(gap), self.coefficient(gap)]
    }
}

/// A model of the viscous force and torque across the line of centres.
pub trait TangentialDrag {
    /// The resistance over the gap of one bridge.
    type Curve: TangentialCurve;

    /// Folds a bridge and the liquid's `viscosity` η (Pa s) into its resistance curve.
    ///
    /// # Errors
    /// [`OutOfRange`] unless the viscosity is positive and finite.
    fn curve(&self, bridge: &Bridge, viscosity: f64) -> Result<Self::Curve, OutOfRange>;
}

/// The tangential resistance of one bridge as a function of the gap alone. Whoever holds many may
/// keep equal ones once.
pub trait TangentialCurve: Copy + PartialEq {
    /// Resistance at `gap` (m, overlap negative); positive semi-definite and finite for every gap.
    fn resistance(&self, gap: f64) -> Resistance;

    /// The resistances A, B and D of bridges side by side: to the bit what
    /// [`TangentialCurve::resistance`] gives for each.
    #[inline(always)]
    fn resistances<L: Lane>(curves: &L::Each<&Self>, gap: L) -> [L; 3] {
        let (permit, gaps) = (gap.permit(), gap.unpack());
        let each = L::each(|k| curves[k].resistance(gaps[k]));
        [
            L::pack(permit, &each, |r| r.slip),
            L::pack(permit, &each, |r| r.coupling),
            L::pack(permit, &each, |r| r.rolling),
        ]
    }

    /// The inverse length κ, 1/m, if in overlap the resistance is `resistance(0) exp(κ S)`, to
    /// rounding; 0 for a constant, infinite for none. `None` if it is anything else.
    fn fade(&self) -> Option<f64> {
        None
    }
}

/// Symmetric tangential resistance of a pair, N s/m.
///
/// With the slip u (relative velocity of the two surfaces, across the line of centres, lever arms
/// l_i + l_j = distance of centres) and the rolling velocity q = R* (ω_i − ω_j) × n:
///
/// ```text
/// F = −(A u + B q)     force on body i; torques l_i n × F on i, l_j n × F on j
/// Q = −(B u + D q)     rolling force; torques R* n × Q on i, −R* n × Q on j
/// ```
///
/// The power F·u + Q·q is never positive if A ≥ 0, D ≥ 0, A D ≥ B², and rigid rotation of the pair
/// (u = q = 0) is untouched.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Resistance {
    /// A: slip to force.
    pub slip: f64,
    /// B: the coupling of slip and rolling.
    pub coupling: f64,
    /// D: rolling to rolling force.
    pub rolling: f64,
}
