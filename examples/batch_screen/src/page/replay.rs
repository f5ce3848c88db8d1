//! Moments of a run for the replay on the page: positions in 16 bits, films in 8.

use serde_json::{Value, json};

use super::embed::base64;
use super::error::PageError;
use super::table::{Source, class, number};

/// Bytes of a particle in a frame: three coordinates of two bytes, and its film.
const PARTICLE: usize = 7;

/// Films above this share of all of them share the strongest colour.
const FILM_QUANTILE: f64 = 0.98;

/// The particles of one moment.
#[derive(Debug, Clone, PartialEq)]
struct Moment {
    /// s.
    time: f64,
    /// Class and `[x, y, z, film]`, m.
    particles: Vec<(u16, [f32; 4])>,
}

/// All moments of `replay.csv`.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Replay {
    moments: Vec<Moment>,
    /// How many moments the file has.
    pub(crate) found: usize,
}

impl Replay {
    /// Reads all moments: rows that follow one another with the same time.
    ///
    /// # Errors
    ///
    /// Where a column is missing or a cell is not what its column holds.
    pub(crate) fn read(source: &Source, classes: &[String]) -> Result<Self, PageError> {
        const COLUMNS: [&str; 6] = ["time_s", "class", "x_m", "y_m", "z_m", "film_m"];
        let header = source.header()?;
        let mut at = [0; 6];
        for (place, name) in at.iter_mut().zip(COLUMNS) {
            let found = header.iter().position(|known| known == name);
            *place = found.ok_or_else(|| source.at(1, format!("no column `{name}`")))?;
        }
        let mut moments: Vec<Moment> = Vec::new();
        source.rows(|record| {
            let cell = |k: usize| record.get(at[k]).unwrap_or_default();
            let time = finite(cell(0), COLUMNS[0])?;
            let mut values = [0.0; 4];
            for (k, value) in values.iter_mut().enumerate() {
                *value = finite(cell(k + 2), COLUMNS[k + 2])? as f32;
            }
            // This table gives classes by their number; a name is understood too.
            let index = cell(1).parse().ok().filter(|k| *k < classes.len());
            let index = index.map_or_else(|| class(cell(1), classes), Ok)?;
            let particle = (index as u16, values);
            match moments.last_mut() {
                Some(last) if last.time == time => last.particles.push(particle),
                _ => moments.push(Moment { time, particles: vec![particle] }),
            }
            Ok(())
        })?;
        let found = moments.len();
        Ok(Self { moments, found })
    }

    /// Leaves out moments, evenly, until the rest takes at most `bytes` on the page. The first and
    /// the last stay where two fit.
    pub(crate) fn thin(&mut self, bytes: usize) {
        let size = |m: &Moment| (PARTICLE * m.particles.len() + 1).div_ceil(3) * 4;
        let mut most = self.moments.len();
        while most > 0 {
            let kept = spread(self.moments.len(), most);
            if kept.iter().map(|k| size(&self.moments[*k])).sum::<usize>() <= bytes {
                let mut index = 0..;
                self.moments.retain(|_| index.next().is_some_and(|k| kept.contains(&k)));
                return;
            }
            most -= 1;
        }
        self.moments.clear();
    }

    /// How many moments are kept.
    pub(crate) fn len(&self) -> usize {
        self.moments.len()
    }

    /// Bounds, times, counts by class, and the moments one after the other: all x, all y, all z as
    /// 16-bit shares of the bounds, then all films as 8-bit shares of `film_max`; particles by class.
    /// A moment of an odd number of particles has one byte more, so that the next starts even.
    pub(crate) fn json(&self, classes: usize) -> Value {
        let bounds = self.bounds();
        let film_max = self.film_max();
        let mut bytes = Vec::new();
        let mut frames = Vec::new();
        for moment in &self.moments {
            let mut sorted: Vec<&(u16, [f32; 4])> = moment.particles.iter().collect();
            sorted.sort_by_key(|(class, _)| *class);
            for (axis, [low, high]) in bounds.iter().enumerate() {
                let span = f64::from(high - low).max(1e-12);
                for (_, values) in &sorted {
                    let share = f64::from(values[axis] - low) / span;
                    bytes.extend_from_slice(&((share * 65_535.0).round() as u16).to_le_bytes());
                }
            }
            for (_, values) in &sorted {
                bytes.push((f64::from(values[3]) / film_max * 255.0).round().min(255.0) as u8);
            }
            if !bytes.len().is_multiple_of(2) {
                bytes.push(0);
            }
            let mut counts = vec![0u32; classes];
            for (class, _) in &sorted {
                if let Some(count) = counts.get_mut(usize::from(*class)) {
                    *count += 1;
                }
            }
            frames.push(json!({ "time": moment.time, "counts": counts }));
        }
        json!({
            "bounds": bounds, "film_max": film_max, "found": self.found,
            "frames": frames, "data": base64(&bytes),
        })
    }

    /// Least and greatest coordinate along each axis, m.
    fn bounds(&self) -> [[f32; 2]; 3] {
        let mut bounds = [[f32::INFINITY, f32::NEG_INFINITY]; 3];
        for (_, values) in self.moments.iter().flat_map(|m| &m.particles) {
            for (bound, value) in bounds.iter_mut().zip(values) {
                *bound = [bound[0].min(*value), bound[1].max(*value)];
            }
        }
        bounds
    }

    /// The film of the strongest colour, m.
    fn film_max(&self) -> f64 {
        let all = self.moments.iter().flat_map(|m| &m.particles);
        let mut films: Vec<f32> = all.map(|(_, values)| values[3]).collect();
        films.sort_by(f32::total_cmp);
        let index = (films.len() as f64 * FILM_QUANTILE) as usize;
        let film = films.get(index.min(films.len().saturating_sub(1))).copied().unwrap_or(0.0);
        if film > 0.0 { f64::from(film) } else { 1.0 }
    }
}

fn finite(cell: &str, column: &str) -> Result<f64, String> {
    let value = number(cell, column)?;
    let told = || format!("`{cell}` in column `{column}`; allowed: a finite number");
    if (value as f32).is_finite() { Ok(value) } else { Err(told()) }
}

/// `most` of `count` indices, evenly spaced, both ends among them where two are asked for.
fn spread(count: usize, most: usize) -> Vec<usize> {
    if most >= count {
        return (0..count).collect();
    }
    let gaps = most.saturating_sub(1).max(1);
    (0..most).map(|k| k * (count - 1) / gaps).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEAD: &str = "time_s,id,class,x_m,y_m,z_m,film_m\n";

    fn read(rows: &str) -> Result<Replay, PageError> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("replay.csv");
        std::fs::write(&path, format!("{HEAD}{rows}")).unwrap();
        let classes = ["a".to_owned(), "b".to_owned()];
        Replay::read(&Source::open(&path)?.unwrap(), &classes)
    }

    fn decode(text: &str) -> Vec<u8> {
        let digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        let values: Vec<u32> =
            text.chars().filter_map(|c| digits.find(c)).map(|k| k as u32).collect();
        let bits: Vec<u32> =
            values.iter().flat_map(|v| (0..6).map(move |k| v >> (5 - k) & 1)).collect();
        bits.chunks_exact(8).map(|b| b.iter().fold(0, |w, bit| w << 1 | *bit as u8)).collect()
    }

    #[test]
    fn moments_are_sorted_by_class_and_quantised() {
        let replay = read(
            "0,0,b,0.0,-1.0,0.0,0.0\n0,1,a,0.5,1.0,0.0,4e-5\n0,2,a,1.0,0.0,0.0,2e-5\n0.1,2,a,1.0,0.0,0.0,2e-5\n",
        )
        .unwrap();
        let json = replay.json(2);
        assert_eq!(json["frames"][0]["counts"], json!([2, 1]));
        assert_eq!(json["frames"][1]["counts"], json!([1, 0]));
        assert_eq!(json["frames"][1]["time"], 0.1);
        assert_eq!(json["bounds"], json!([[0.0, 1.0], [-1.0, 1.0], [0.0, 0.0]]));
        let bytes = decode(json["data"].as_str().unwrap());
        // Three particles of 7 bytes and one byte more, then one of 7 and one more.
        assert_eq!(bytes.len(), 22 + 8);
        let word = |k: usize| u16::from_le_bytes([bytes[2 * k], bytes[2 * k + 1]]);
        assert_eq!([word(0), word(1), word(2)], [32_768, 65_535, 0]); // x of 1, 2, 0
        assert_eq!([word(3), word(4), word(5)], [65_535, 32_768, 0]); // y
        assert_eq!([word(6), word(7), word(8)], [0, 0, 0]); // z: all the same
        assert_eq!(bytes[18..21], [255, 128, 0]); // films of at most 4e-5
    }

    #[test]
    fn thinning_keeps_within_the_bytes_and_both_ends() {
        let rows: String =
            (0..50).flat_map(|t| (0..30).map(move |k| format!("{t},{k},a,0,0,0,0\n"))).collect();
        let whole = read(&rows).unwrap();
        for bytes in [0, 100, 300, 1000, 5000, 1_000_000] {
            let mut replay = whole.clone();
            replay.thin(bytes);
            let json = replay.json(2);
            assert!(json["data"].as_str().unwrap().len() <= bytes + 4);
            assert_eq!(replay.len(), (bytes / 284).min(50), "{bytes}");
            if replay.len() > 1 {
                assert_eq!(
                    (replay.moments[0].time, replay.moments[replay.len() - 1].time),
                    (0.0, 49.0)
                );
            }
        }
    }

    #[test]
    fn broken_rows_are_told() {
        let told = |rows: &str| read(rows).unwrap_err().to_string();
        assert!(told("0,0,c,0,0,0,0\n").ends_with("line 2: class `c`; allowed: a, b"));
        let end = "line 3: `inf` in column `y_m`; allowed: a finite number";
        assert!(told("0,0,a,0,0,0,0\n0,1,a,0,inf,0,0\n").ends_with(end));
        assert!(told("0,0,a,,0,0,0\n").ends_with("allowed: a finite number"));
        assert_eq!(read("").unwrap().len(), 0);
    }
}
