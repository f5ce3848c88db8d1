//! `contact`: loading and unloading of a dry contact.

use std::io::{Read, Write};

use clap::ValueEnum;
use csv::StringRecord;
use pendular_contact::{
    AnyContact, ContactModel, ElasticPlastic, HertzMindlin, NormalContact, PlasticMemory,
};

use crate::status::{Trouble, Trust, digits};
use crate::table::{Table, TableError, number};

const HEADER: [&str; 5] = ["e_star", "r_star", "yield_pressure", "displacement_max", "steps"];
const ADDED: [&str; 4] = ["branch", "displacement", "force", "status"];
/// More steps than anyone plots.
const MOST_STEPS: u32 = 1_000_000;

/// The contact laws that a modulus and a radius determine.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Model {
    /// Hertz' force, without a dashpot
    HertzMindlin,
    /// Hertz up to the yield pressure, then elastic-plastic; unloading with permanent deformation
    ElasticPlastic,
}

impl Model {
    pub(crate) const ALL: [Self; 2] = [Self::HertzMindlin, Self::ElasticPlastic];

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::HertzMindlin => ContactModel::HertzMindlin.name(),
            Self::ElasticPlastic => ContactModel::ElasticPlastic.name(),
        }
    }

    pub(crate) fn source(self) -> &'static str {
        match self {
            Self::HertzMindlin => "Hertz (1882); Mindlin (1949), J. Appl. Mech. 16, 259",
            Self::ElasticPlastic => "Krull, Strohner, Antonyuk (2025), KONA, section 2.2",
        }
    }

    fn law(self, row: &StringRecord) -> Result<AnyContact, Trouble> {
        let (modulus, radius) = (number(row, 0)?, number(row, 1)?);
        let law = match self {
            Self::HertzMindlin => HertzMindlin::elastic(modulus, radius).map(AnyContact::from),
            Self::ElasticPlastic => {
                ElasticPlastic::new(modulus, radius, number(row, 2)?).map(AnyContact::from)
            }
        };
        law.map_err(|_| Trouble::Invalid)
    }
}

/// Greatest displacement, m, and number of steps.
fn path(row: &StringRecord) -> Result<(f64, u32), Trouble> {
    let (most, steps) = (number(row, 3)?, number(row, 4)?);
    let whole = steps.fract() == 0.0 && (1.0..=f64::from(MOST_STEPS)).contains(&steps);
    let positive = most > 0.0 && most.is_finite();
    if whole && positive { Ok((most, steps as u32)) } else { Err(Trouble::Invalid) }
}

pub(crate) fn run(model: Model, input: impl Read, output: impl Write) -> Result<(), TableError> {
    let mut table = Table::new(input, output, &HEADER, &ADDED)?;
    while let Some(row) = table.read()? {
        match model.law(&row).and_then(|law| Ok((law, path(&row)?))) {
            Ok((law, (most, steps))) => curve(&mut table, &row, law, most, steps)?,
            Err(trouble) => table.write(&row, &["", "", "", &trouble.to_string()])?,
        }
    }
    table.finish()
}

/// Writes a contact that is pressed to `most` and let go, quasi-statically.
fn curve<R: Read, W: Write>(
    table: &mut Table<R, W>,
    row: &StringRecord,
    law: AnyContact,
    most: f64,
    steps: u32,
) -> Result<(), TableError> {
    let mut memory = PlasticMemory::default();
    let loading = (0..=steps).map(|step| ("loading", step));
    let unloading = (0..=steps).rev().map(|step| ("unloading", step));
    for (branch, step) in loading.chain(unloading) {
        // The last step is `most` itself, without rounding.
        let displacement =
            if step == steps { most } else { most * (f64::from(step) / f64::from(steps)) };
        let force = law.force(displacement, 0.0, &mut memory);
        let status =
            if force.is_finite() { Trust::Ok.to_string() } else { Trouble::NoValue.to_string() };
        let force = if force.is_finite() { digits(force) } else { String::new() };
        table.write(row, &[branch, &digits(displacement), &force, &status])?;
    }
    Ok(())
}
