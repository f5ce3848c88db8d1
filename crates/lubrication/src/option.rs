//! A drag that may be absent: `None` drags nothing.

use pendular_lane::Lane;
use pendular_pair::{Bridge, OutOfRange};

use crate::{NormalCurve, NormalDrag, Resistance, TangentialCurve, TangentialDrag};

/// The curves, if all are there.
#[inline(always)]
fn all<'a, L: Lane, C>(curves: &L::Each<&'a Option<C>>) -> Option<L::Each<&'a C>> {
    let first = curves[0].as_ref()?;
    let mut all = L::each(|_| first);
    for k in 1..L::WIDTH {
        all[k] = curves[k].as_ref()?;
    }
    Some(all)
}

impl<D: NormalDrag> NormalDrag for Option<D> {
    type Curve = Option<D::Curve>;

    fn curve(&self, bridge: &Bridge, viscosity: f64) -> Result<Self::Curve, OutOfRange> {
        self.as_ref().map(|drag| drag.curve(bridge, viscosity)).transpose()
    }
}

impl<C: NormalCurve> NormalCurve for Option<C> {
    #[inline]
    fn coefficient(&self, gap: f64) -> f64 {
        self.as_ref().map_or(0.0, |curve| curve.coefficient(gap))
    }

    #[inline(always)]
    fn coefficients<L: Lane>(curves: &L::Each<&Self>, gap: L) -> L {
        if let Some(own) = all::<L, C>(curves) {
            return C::coefficients(&own, gap);
        }
        let gaps = gap.unpack();
        L::pack(gap.permit(), &L::each(|k| curves[k].coefficient(gaps[k])), |c| *c)
    }

    fn fade(&self) -> Option<f64> {
        self.as_ref().map_or(Some(0.0), C::fade)
    }

    #[inline]
    fn clearance(&self, gap: f64) -> f64 {
        self.as_ref().map_or(0.0, |curve| curve.clearance(gap))
    }

    #[inline(always)]
    fn clearances<L: Lane>(curves: &L::Each<&Self>, gap: L) -> L {
        if let Some(own) = all::<L, C>(curves) {
            return C::clearances(&own, gap);
        }
        let gaps = gap.unpack();
        L::pack(gap.permit(), &L::each(|k| curves[k].clearance(gaps[k])), |c| *c)
    }

    #[inline]
    fn impulse(&self, gap: f64) -> f64 {
        self.as_ref().map_or(0.0, |curve| curve.impulse(gap))
    }

    #[inline]
    fn charge(&self, gap: f64) -> [f64; 2] {
        self.as_ref().map_or([0.0; 2], |curve| curve.charge(gap))
    }
}

impl<D: TangentialDrag> TangentialDrag for Option<D> {
    type Curve = Option<D::Curve>;

    fn curve(&self, bridge: &Bridge, viscosity: f64) -> Result<Self::Curve, OutOfRange> {
        self.as_ref().map(|drag| drag.curve(bridge, viscosity)).transpose()
    }
}

impl<C: TangentialCurve> TangentialCurve for Option<C> {
    #[inline]
    fn resistance(&self, gap: f64) -> Resistance {
        self.as_ref().map_or_else(Resistance::default, |curve| curve.resistance(gap))
    }

    #[inline(always)]
    fn resistances<L: Lane>(curves: &L::Each<&Self>, gap: L) -> [L; 3] {
        if let Some(own) = all::<L, C>(curves) {
            return C::resistances(&own, gap);
        }
        let (permit, gaps) = (gap.permit(), gap.unpack());
        let each = L::each(|k| curves[k].resistance(gaps[k]));
        [
            L::pack(permit, &each, |r| r.slip),
            L::pack(permit, &each, |r| r.coupling),
            L::pack(permit, &each, |r| r.rolling),
        ]
    }

    fn fade(&self) -> Option<f64> {
        self.as_ref().map_or(Some(0.0), C::fade)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Pitois2000, Popov2010, Regularisation};
    use pendular_pair::Mate;

    #[test]
    fn none_drags_nothing_and_some_is_the_law_itself() {
        let bridge =
            Bridge::new(1e-3, Mate::Sphere { radius: 2e-3 }, 1e-11, [0.0; 2], 0.07).unwrap();
        let near = Regularisation::default();
        let (normal, tangential) = (Pitois2000 { near }, Popov2010 { near });
        let (no_normal, no_tangential) = (None::<Pitois2000>, None::<Popov2010>);
        for gap in [-1e-6, 0.0, 1e-5] {
            let some = Some(normal).curve(&bridge, 1e-3).unwrap();
            let law = normal.curve(&bridge, 1e-3).unwrap();
            assert_eq!(some.coefficient(gap), law.coefficient(gap));
            assert_eq!(some.impulse(gap), law.impulse(gap));
            let none = no_normal.curve(&bridge, 1e-3).unwrap();
            assert_eq!((none.coefficient(gap), none.impulse(gap)), (0.0, 0.0));
            let some = Some(tangential).curve(&bridge, 1e-3).unwrap();
            let law = tangential.curve(&bridge, 1e-3).unwrap();
            assert_eq!(some.resistance(gap), law.resistance(gap));
            let none = no_tangential.curve(&bridge, 1e-3).unwrap();
            assert_eq!(none.resistance(gap), Resistance::default());
        }
        assert!(Some(normal).curve(&bridge, -1.0).is_err(), "errors are those of the law");
    }
}
