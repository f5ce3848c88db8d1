//! The form of names and regularisation in files.
#![cfg(feature = "serde")]
#![allow(clippy::unwrap_used)]

use pendular_lubrication::{Gap, NormalModel, Overlap, Regularisation, TangentialModel};
use serde_json::{from_str, json, to_value};

#[test]
fn laws_are_their_names() {
    for model in NormalModel::ALL {
        assert_eq!(to_value(model).unwrap(), model.name());
    }
    for model in TangentialModel::ALL {
        assert_eq!(to_value(model).unwrap(), model.name());
    }
    assert!(from_str::<TangentialModel>("\"goldman-literal\"").is_err());
}

#[test]
fn regularisation_reads_what_it_writes() {
    let near = Regularisation { gap: Gap::CutOff { length: 1e-6 }, overlap: Overlap::Off };
    let written = json!({ "gap": { "cut_off": { "length": 1e-6 } }, "overlap": "off" });
    assert_eq!(to_value(near).unwrap(), written);
    assert_eq!(from_str::<Regularisation>(&written.to_string()).unwrap(), near);
    assert_eq!(from_str::<Regularisation>("{}").unwrap(), Regularisation::default());
    assert!(from_str::<Regularisation>(r#"{ "roughness": 1e-6 }"#).is_err());
}
