use glam::DVec3;

/// One contact, or near contact, of a sphere with a wall part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touch {
    /// The part's element (liquid patch) that holds the closest point.
    pub element: u32,
    /// Distance from the sphere's surface to the wall's surface, m; negative where they overlap.
    pub gap: f64,
    /// Unit vector from the sphere's centre towards the wall.
    pub normal: DVec3,
}

/// Two closest points count as one contact where the second lies in front of the first one's
/// tangent plane by less than this part of the distance to the centre. Two faces that meet in a
/// valley flatter than about its square root (1 mrad) are thus one face.
const SAME_PLANE: f64 = 1e-6;

/// Sorts the hits of one mesh by distance and keeps the first of each group that is one contact.
///
/// A hit is dropped when its closest point lies on, or behind, the tangent plane of a nearer kept
/// hit (the plane through that hit's closest point, across its normal). So go the edges and
/// vertices of a face that is kept, the second triangle at a shared edge, and the back of a thick
/// wall; the two faces of an inner corner stay, because each lies in front of the other.
///
/// `tolerance` (m) is how far coplanar faces may be out of plane, such as by rounding in a file.
pub(crate) fn merge(touches: &mut Vec<Touch>, radius: f64, tolerance: f64) {
    if touches.len() < 2 {
        return;
    }
    // total_cmp and the element as second key: the same order whatever the candidates' order.
    touches.sort_unstable_by(|a, b| a.gap.total_cmp(&b.gap).then(a.element.cmp(&b.element)));
    let mut kept = 1;
    for k in 1..touches.len() {
        let touch = touches[k];
        let distance = touch.gap + radius;
        let hidden = touches[..kept].iter().any(|near| {
            let nearest = near.gap + radius;
            distance * touch.normal.dot(near.normal) - nearest >= -SAME_PLANE * nearest - tolerance
        });
        if !hidden {
            touches[kept] = touch;
            kept += 1;
        }
    }
    touches.truncate(kept);
}
