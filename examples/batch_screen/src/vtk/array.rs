//! Data arrays of VTK XML files: named columns, encoded as zlib-compressed blocks.

use std::io::Write;

use flate2::Compression;
use flate2::write::ZlibEncoder;

use super::error::VtkError;

/// Bytes of a block before compression, as VTK's own writers have it.
pub(crate) const BLOCK: usize = 32_768;

/// A column of numbers with one or more components per entry.
pub(crate) struct Array {
    /// Its name in ParaView.
    pub(crate) name: &'static str,
    /// VTK's name of the number type.
    pub(crate) kind: &'static str,
    /// Numbers per entry.
    pub(crate) components: usize,
    /// Little-endian numbers.
    pub(crate) bytes: Vec<u8>,
}

impl Array {
    /// Single-precision numbers: enough for pictures, half the size.
    ///
    /// # Errors
    ///
    /// Where a number is not finite, or too large for single precision.
    pub(crate) fn floats(
        name: &'static str,
        components: usize,
        values: impl Iterator<Item = f64>,
    ) -> Result<Self, VtkError> {
        let mut bytes = Vec::new();
        for (index, value) in values.enumerate() {
            let short = value as f32;
            if !short.is_finite() {
                return Err(VtkError::Value { array: name, index: index / components, value });
            }
            bytes.extend_from_slice(&short.to_le_bytes());
        }
        Ok(Self { name, kind: "Float32", components, bytes })
    }

    /// Whole numbers of 32 bits.
    pub(crate) fn int32(name: &'static str, values: impl Iterator<Item = i32>) -> Self {
        let bytes = values.flat_map(i32::to_le_bytes).collect();
        Self { name, kind: "Int32", components: 1, bytes }
    }

    /// Whole numbers of 64 bits.
    pub(crate) fn int64(name: &'static str, values: impl Iterator<Item = i64>) -> Self {
        let bytes = values.flat_map(i64::to_le_bytes).collect();
        Self { name, kind: "Int64", components: 1, bytes }
    }

    /// The XML element that points to the array's place in the appended data.
    pub(crate) fn element(&self, offset: usize) -> String {
        format!(
            "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{offset}\"/>\n",
            self.kind, self.name, self.components
        )
    }

    /// Header and compressed blocks, as `vtkZLibDataCompressor` reads them:
    ///
    /// ```text
    /// [number of blocks] [bytes of a block] [bytes of the last block if partial, else 0]
    /// [compressed bytes of block 1] … [compressed bytes of block n]     (UInt64 each)
    /// block 1 … block n                                                 (zlib streams)
    /// ```
    ///
    /// # Errors
    ///
    /// What the compressor reports; in memory it has no reason to.
    pub(crate) fn encode(&self) -> std::io::Result<Vec<u8>> {
        let count = self.bytes.len().div_ceil(BLOCK);
        let mut header = vec![count as u64, BLOCK as u64, (self.bytes.len() % BLOCK) as u64];
        let mut body = Vec::new();
        for block in self.bytes.chunks(BLOCK) {
            let mut encoder = ZlibEncoder::new(Vec::new(), Compression::fast());
            encoder.write_all(block)?;
            let compressed = encoder.finish()?;
            header.push(compressed.len() as u64);
            body.extend_from_slice(&compressed);
        }
        let mut out: Vec<u8> = header.into_iter().flat_map(u64::to_le_bytes).collect();
        out.extend_from_slice(&body);
        Ok(out)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(bytes: &[u8], count: usize) -> Vec<u64> {
        let word = |chunk: &[u8]| u64::from_le_bytes(chunk.try_into().unwrap());
        bytes.chunks(8).take(count).map(word).collect()
    }

    #[test]
    fn headers_of_empty_partial_and_full_blocks() {
        let of = |n: usize| Array::int64("id", 0..n as i64).encode().unwrap();
        assert_eq!(words(&of(0), 3), [0, BLOCK as u64, 0]);
        assert_eq!(of(0).len(), 24);
        assert_eq!(words(&of(3), 3), [1, BLOCK as u64, 24]);
        // 4096 numbers of 8 bytes fill one block: no partial block.
        assert_eq!(words(&of(4096), 3), [1, BLOCK as u64, 0]);
        assert_eq!(words(&of(4097), 3), [2, BLOCK as u64, 8]);
    }

    #[test]
    fn sizes_in_the_header_are_those_of_the_streams() {
        let encoded = Array::int64("id", 0..10_000).encode().unwrap();
        let head = words(&encoded, 6);
        assert_eq!(head[0], 3);
        let total: u64 = head[3..].iter().sum();
        assert_eq!(encoded.len() as u64, 48 + total);
        // Every zlib stream of a 32 KiB window starts with 0x78.
        let mut at = 48;
        for size in &head[3..] {
            assert_eq!(encoded[at], 0x78);
            at += *size as usize;
        }
    }

    #[test]
    fn refuses_what_is_not_a_number() {
        for bad in [f64::NAN, f64::INFINITY, 1e300] {
            let array = Array::floats("velocity", 3, [0.0, 1.0, 2.0, 3.0, bad].into_iter());
            let Err(VtkError::Value { array: name, index, .. }) = array else { panic!("{bad}") };
            assert_eq!((name, index), ("velocity", 1));
        }
    }
}
