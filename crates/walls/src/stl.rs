use std::io::Cursor;
use std::path::Path;

use glam::DVec3;

use crate::error::Origin;
use crate::{Mesh, WallError};

/// Bytes before the triangles of a binary STL file, and bytes of each triangle.
const HEADER: usize = 84;
const RECORD: usize = 50;

impl Mesh {
    /// Reads an STL file, binary or ASCII; `scale` is the length of its unit in m (1e-3 for a file
    /// in millimetres: STL files do not say).
    ///
    /// A file is binary if its length fits its number of triangles, whatever its header says.
    /// The facet normals in the file are ignored. Coordinates have single precision, so the mesh
    /// gets a tolerance ([`Mesh::with_tolerance`]) of their rounding.
    ///
    /// # Errors
    /// [`WallError::Read`] where the file cannot be read, [`WallError::Broken`] where it is cut
    /// short, has trailing bytes or does not follow the format, else as [`Mesh::new`] with the
    /// path; [`WallError::OutOfRange`] unless `scale` is positive and finite.
    pub fn from_stl(path: impl AsRef<Path>, scale: f64) -> Result<Self, WallError> {
        let path = path.as_ref();
        WallError::positive(&path.display().to_string(), "scale", scale)?;
        let bytes =
            std::fs::read(path).map_err(|source| WallError::Read { path: path.into(), source })?;
        let triangles =
            parse(bytes).map_err(|reason| WallError::Broken { path: path.into(), reason })?;
        let scaled: Vec<[DVec3; 3]> =
            triangles.iter().map(|t| t.map(|corner| corner * scale)).collect();
        let largest = scaled.iter().flatten().map(|p| p.abs().max_element()).fold(0.0, f64::max);
        let mesh = Self::weld(&scaled, &Origin::File(path.into()))?;
        Ok(mesh.with_tolerance(2.0 * f64::from(f32::EPSILON) * largest))
    }

    /// Writes the mesh as a binary STL file in units of `scale` m (1e-3: millimetres), in single
    /// precision.
    ///
    /// # Errors
    /// As the writer reports, and of kind `InvalidInput` unless `scale` is positive and finite.
    pub fn write_stl(&self, writer: &mut impl std::io::Write, scale: f64) -> std::io::Result<()> {
        if !(scale > 0.0 && scale < f64::INFINITY) {
            let kind = std::io::ErrorKind::InvalidInput;
            return Err(std::io::Error::new(kind, format!("scale = {scale} is not positive")));
        }
        let facets: Vec<stl_io::Triangle> = self
            .indices()
            .iter()
            .map(|t| {
                let [a, b, c] = t.map(|v| self.points()[v as usize] / scale);
                let normal = (b - a).cross(c - a).normalize_or_zero();
                stl_io::Triangle {
                    normal: stl_io::Normal::new(normal.as_vec3().to_array()),
                    vertices: [a, b, c].map(|p| stl_io::Vertex::new(p.as_vec3().to_array())),
                }
            })
            .collect();
        stl_io::write_stl(writer, facets.iter())
    }
}

/// The triangles of an STL file in its own unit, or what is wrong with it.
fn parse(mut bytes: Vec<u8>) -> Result<Vec<[DVec3; 3]>, String> {
    let declared = bytes
        .get(HEADER - 4..HEADER)
        .map(|count| count.iter().rev().fold(0usize, |sum, byte| (sum << 8) | usize::from(*byte)));
    let binary = declared.is_some_and(|n| bytes.len() == HEADER + n.saturating_mul(RECORD));
    let ascii = !binary && bytes.starts_with(b"solid");
    let mut facets_said = declared.unwrap_or(0);
    if binary {
        // Some programs begin a binary file with "solid", which the reader takes for ASCII.
        bytes[..HEADER - 4].fill(0);
    } else if ascii {
        let text = std::str::from_utf8(&bytes)
            .map_err(|_| "neither the length of a binary file nor text".to_string())?;
        facets_said = text.split_whitespace().filter(|word| *word == "endfacet").count();
        // The reader wants a blank after "solid", also where no name follows.
        bytes.splice(5..5, *b" ");
    } else {
        let Some(n) = declared else {
            return Err(format!("{} bytes are too few for a file", bytes.len()));
        };
        let length = bytes.len();
        return Err(format!("{n} triangles declared, but the file has {length} bytes"));
    }
    let mut cursor = Cursor::new(bytes);
    let reader = stl_io::create_stl_reader(&mut cursor).map_err(|e| e.to_string())?;
    let mut triangles = Vec::new();
    for (k, triangle) in reader.enumerate() {
        let triangle = triangle.map_err(|e| format!("triangle {k}: {e}"))?;
        triangles.push(triangle.vertices.map(|v| glam::Vec3::from_array(v.0).as_dvec3()));
    }
    if triangles.len() != facets_said {
        let read = triangles.len();
        return Err(format!("{facets_said} facets, but only {read} in the first solid"));
    }
    Ok(triangles)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A tetrahedron with corners that single precision holds exactly.
    fn tetrahedron() -> Mesh {
        let points = vec![DVec3::ZERO, DVec3::X, DVec3::Y * 2.0, DVec3::Z * 0.5];
        Mesh::new(points, vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]).unwrap()
    }

    fn ascii(mesh: &Mesh, head: &str) -> String {
        let mut text = format!("{head}\n");
        for t in mesh.indices() {
            text += "facet normal 0 0 0\n  outer loop\n";
            for v in t {
                let p = mesh.points()[*v as usize];
                text += &format!("    vertex {} {:e} {}\n", p.x, p.y, p.z);
            }
            text += "  endloop\nendfacet\n";
        }
        text + "endsolid\n"
    }

    fn binary(mesh: &Mesh) -> Vec<u8> {
        let mut bytes = Vec::new();
        mesh.write_stl(&mut bytes, 1.0).unwrap();
        bytes
    }

    fn read(bytes: &[u8]) -> Result<Mesh, WallError> {
        let file = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(file.path(), bytes).unwrap();
        let result = Mesh::from_stl(file.path(), 1.0);
        if let Err(error) = &result {
            let name = file.path().file_name().unwrap().to_str().unwrap();
            assert!(error.to_string().contains(name), "{error}");
        }
        result
    }

    fn corners(mesh: &Mesh) -> Vec<[DVec3; 3]> {
        mesh.indices().iter().map(|t| t.map(|v| mesh.points()[v as usize])).collect()
    }

    #[test]
    fn both_kinds_come_back_with_shared_vertices() {
        let mesh = tetrahedron();
        let mut solid = binary(&mesh);
        solid[..6].copy_from_slice(b"solid ");
        let files = [
            binary(&mesh),
            solid,
            ascii(&mesh, "solid a tetrahedron").into_bytes(),
            ascii(&mesh, "solid").into_bytes(),
        ];
        for bytes in files {
            let back = read(&bytes).unwrap();
            assert_eq!(back.points().len(), 4);
            assert_eq!(corners(&back), corners(&mesh));
        }
    }

    #[test]
    fn the_scale_is_the_unit() {
        let file = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(file.path(), binary(&tetrahedron())).unwrap();
        let mesh = Mesh::from_stl(file.path(), 1e-3).unwrap();
        assert_eq!(mesh.points()[1], DVec3::Y * 2e-3);
        assert!(matches!(
            Mesh::from_stl(file.path(), 0.0),
            Err(WallError::OutOfRange { quantity: "scale", .. })
        ));
        let mut bytes = Vec::new();
        mesh.write_stl(&mut bytes, 1e-3).unwrap();
        assert_eq!(bytes[80..], binary(&tetrahedron())[80..]);
    }

    #[test]
    fn broken_files_are_told_apart() {
        let good = binary(&tetrahedron());
        let broken = |bytes: &[u8]| matches!(read(bytes), Err(WallError::Broken { .. }));
        assert!(broken(b""));
        assert!(broken(b"not an STL file"));
        assert!(broken(b"solid"));
        assert!(broken(b"solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n"));
        assert!(broken(&good[..good.len() - 1]));
        assert!(broken(&[good.as_slice(), b"x"].concat()));
        let text = ascii(&tetrahedron(), "solid x");
        assert!(broken(&text.as_bytes()[..text.len() / 2]));
        assert!(broken(text.replace("0.5", "nan").as_bytes()));
        assert!(broken(text.replace("0.5", "half").as_bytes()));
        // A second solid would be lost in silence.
        assert!(broken(format!("{text}{text}").as_bytes()));
        assert!(matches!(read(b"solid x\nendsolid x\n"), Err(WallError::Empty { .. })));
        assert!(matches!(read(&[0; 84]), Err(WallError::Empty { .. })));
        let missing = Mesh::from_stl("no/such/file.stl", 1.0).unwrap_err();
        assert!(matches!(missing, WallError::Read { .. }));
        assert!(missing.to_string().contains("no/such/file.stl"));
    }

    #[test]
    fn bad_triangles_are_told_with_their_number() {
        let mut nan = binary(&tetrahedron());
        // Triangle 2, first corner, x.
        let at = HEADER + 2 * RECORD + 12;
        nan[at..at + 4].copy_from_slice(&f32::NAN.to_le_bytes());
        assert!(matches!(read(&nan), Err(WallError::NotFinite { triangle: 2, .. })));
        let mut flat = binary(&tetrahedron());
        // Triangle 1: the second corner onto the first.
        let at = HEADER + RECORD + 12;
        flat.copy_within(at..at + 12, at + 12);
        assert!(matches!(read(&flat), Err(WallError::Degenerate { triangle: 1, .. })));
    }
}
