//! Benchmarks of the kernels; see the README beside this package.
