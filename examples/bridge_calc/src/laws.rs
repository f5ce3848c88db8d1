//! `laws`: what there is.

use std::io::Write;

use pendular_capillary::AnyCapillary;
use pendular_pair::Validity;
use pendular_transfer::AnyRupture;
use pendular_transfer::rupture::Mikami1998;

use crate::contact::Model;
use crate::rupture::RuptureChoice;
use crate::table::TableError;
use crate::transfer::Method;

const HEADER: [&str; 11] = [
    "command",
    "name",
    "kind",
    "v_star_min",
    "v_star_max",
    "theta_min_deg",
    "theta_max_deg",
    "theta_difference_max_deg",
    "radius_ratio_min",
    "radius_ratio_max",
    "source",
];

pub(crate) fn run(output: impl Write) -> Result<(), TableError> {
    let mut table = csv::Writer::from_writer(output);
    let mut rows = vec![HEADER.map(str::to_owned).to_vec()];
    for law in AnyCapillary::ALL {
        let info = law.info();
        rows.push(row(["force", info.name, &info.kind.to_string()], info.validity, info.source));
    }
    for law in RuptureChoice::all() {
        rows.push(row(["rupture", law.name(), kind(law.validity())], law.validity(), law.source()));
        if law == RuptureChoice::Formula(AnyRupture::Mikami) {
            let wall = Mikami1998::WALL;
            rows.push(row(["rupture", law.name(), "sphere-plane"], wall, law.source()));
        }
    }
    for method in Method::ALL {
        let kind = kind(method.validity());
        rows.push(row(["transfer", method.name(), kind], method.validity(), method.source()));
    }
    for model in Model::ALL {
        let blank = std::iter::repeat_n(String::new(), 7);
        let mut fields: Vec<String> =
            ["contact", model.name(), "sphere-sphere and sphere-plane"].map(str::to_owned).into();
        fields.extend(blank);
        fields.push(model.source().to_owned());
        rows.push(fields);
    }
    for row in rows {
        table.write_record(row).map_err(TableError::writing)?;
    }
    table.flush().map_err(TableError::Write)
}

fn kind(range: Validity) -> &'static str {
    if range.radius_ratio.1.is_infinite() {
        "sphere-sphere and sphere-plane"
    } else {
        "sphere-sphere"
    }
}

fn row(what: [&str; 3], range: Validity, source: &str) -> Vec<String> {
    let Validity { v_star, contact_angle, angle_difference, radius_ratio } = range;
    // Degrees to 1e-9, so that 50° in radians reads as 50 again.
    let degrees = |angle: f64| ((angle.to_degrees() * 1e9).round() / 1e9).to_string();
    let mut fields: Vec<String> = what.map(str::to_owned).into();
    fields.extend([v_star.0.to_string(), v_star.1.to_string()]);
    fields.extend([contact_angle.0, contact_angle.1, angle_difference].map(degrees));
    fields.extend([radius_ratio.0.to_string(), radius_ratio.1.to_string()]);
    fields.push(source.to_owned());
    fields
}
