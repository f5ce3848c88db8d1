//! Which crate may depend on which: laws see no integrator, the core sees no liquid, only the
//! walls see parry.

use std::collections::{BTreeMap, BTreeSet};

use cargo_metadata::{DependencyKind, MetadataCommand};

/// Allowed edges between our own crates, and nothing else.
const ALLOWED: &[(&str, &[&str])] = &[
    ("pendular-lane", &[]),
    ("pendular-pair", &[]),
    ("pendular-capillary", &["pendular-lane", "pendular-pair"]),
    ("pendular-lubrication", &["pendular-lane", "pendular-pair"]),
    ("pendular-transfer", &["pendular-pair", "pendular-capillary"]),
    ("pendular-contact", &["pendular-lane"]),
    ("pendular-walls", &[]),
    ("pendular-dem-core", &["pendular-contact", "pendular-lane"]),
    (
        "pendular",
        &[
            "pendular-capillary",
            "pendular-contact",
            "pendular-dem-core",
            "pendular-lubrication",
            "pendular-pair",
            "pendular-transfer",
            "pendular-walls",
        ],
    ),
    ("drawing", &[]),
    ("batch_screen", &["pendular"]),
    ("stability_map", &["drawing", "pendular"]),
    (
        "bridge_calc",
        &[
            "drawing",
            "pendular-capillary",
            "pendular-contact",
            "pendular-lubrication",
            "pendular-pair",
            "pendular-transfer",
        ],
    ),
];

/// Normal dependencies of every package of the workspace.
fn dependencies() -> BTreeMap<String, BTreeSet<String>> {
    let metadata = MetadataCommand::new()
        .manifest_path(concat!(env!("CARGO_MANIFEST_DIR"), "/../Cargo.toml"))
        .no_deps()
        .other_options(vec!["--offline".into()])
        .exec()
        .unwrap();
    let normal = |p: &cargo_metadata::Package| {
        let edges = p.dependencies.iter().filter(|d| d.kind == DependencyKind::Normal);
        edges.map(|d| d.name.clone()).collect()
    };
    metadata.packages.iter().map(|p| (p.name.to_string(), normal(p))).collect()
}

#[test]
fn only_allowed_edges() {
    let all = dependencies();
    for (name, allowed) in ALLOWED {
        let edges = all.get(*name).unwrap_or_else(|| panic!("no package {name}"));
        for edge in edges.iter().filter(|edge| all.contains_key(*edge)) {
            assert!(allowed.contains(&edge.as_str()), "{name} must not depend on {edge}");
        }
    }
}

#[test]
fn only_the_walls_name_parry() {
    for (name, edges) in dependencies() {
        let parry = edges.iter().any(|edge| edge.starts_with("parry"));
        assert_eq!(parry, name == "pendular-walls", "{name}");
    }
}

#[test]
fn law_crates_are_light() {
    let light =
        ["thiserror", "serde", "csv", "pendular-lane", "pendular-pair", "pendular-capillary"];
    for name in ["pair", "capillary", "lubrication", "transfer", "contact"] {
        for edge in &dependencies()[&format!("pendular-{name}")] {
            assert!(light.contains(&edge.as_str()), "{name} depends on {edge}");
        }
    }
}
