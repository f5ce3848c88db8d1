use std::ops::{Add, Mul};

/// The few operations on complex numbers that the meridian needs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Complex {
    pub(super) re: f64,
    pub(super) im: f64,
}

impl Complex {
    pub(super) fn new(re: f64, im: f64) -> Self {
        Self { re, im }
    }

    pub(super) fn polar(modulus: f64, argument: f64) -> Self {
        let (sin, cos) = argument.sin_cos();
        Self::new(modulus * cos, modulus * sin)
    }

    pub(super) fn scale(self, factor: f64) -> Self {
        Self::new(self.re * factor, self.im * factor)
    }

    /// i times the number.
    pub(super) fn turn(self) -> Self {
        Self::new(-self.im, self.re)
    }

    pub(super) fn modulus(self) -> f64 {
        (self.re * self.re + self.im * self.im).sqrt()
    }

    /// Real part of the product with the other's conjugate.
    pub(super) fn dot(self, other: Self) -> f64 {
        self.re * other.re + self.im * other.im
    }

    /// Imaginary part of `other` times the conjugate of `self`.
    pub(super) fn cross(self, other: Self) -> f64 {
        self.re * other.im - self.im * other.re
    }
}

impl Add for Complex {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::new(self.re + other.re, self.im + other.im)
    }
}

impl Mul for Complex {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self::new(self.re * other.re - self.im * other.im, self.re * other.im + self.im * other.re)
    }
}
