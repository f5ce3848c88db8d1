use super::*;

#[test]
fn pulls_only_when_allowed() {
    let law = Linear::new(1e4, 2.0).unwrap();
    // 1e4 · 1e-5 − 2 · 0.1 = −0.1 N
    assert_eq!(law.force(1e-5, -0.1, &mut ()), 0.0);
    let pulling = law.with_dashpot(Dashpot::MayPull).force(1e-5, -0.1, &mut ());
    assert!((pulling + 0.1).abs() < 1e-15);
}

#[test]
fn the_shear_cell_of_gladkyy_and_schwarze() {
    // r = 2.381 mm, ρ = 150 kg/m³, e = 0.83: k_n = 144.03 N/m, c_n = 2.92e-3 N s/m,
    // t_c = 5.4e-4 s (Gladkyy & Schwarze 2014, section 4.1)
    let mass = 4.0 / 3.0 * std::f64::consts::PI * 2.381e-3_f64.powi(3) * 150.0;
    let may_pull = Dashpot::MayPull;
    let law = Linear::from_restitution_with(144.03, 0.83, 0.5 * mass, may_pull).unwrap();
    assert!((law.contact_time(0.5 * mass).unwrap() / 5.4e-4 - 1.0).abs() < 1e-4);
    assert!((law.damping(0.0) / 2.92e-3 - 1.0).abs() < 5e-3);
}

#[test]
fn tangential_stiffness_is_a_share_of_the_normal_one() {
    let law = Linear::new(1e5, 0.0).unwrap();
    // ν = 0.3: 0.7/0.85
    assert!((law.tangential_stiffness(1.0) / 1e5 - 0.823_529_411_76).abs() < 1e-10);
    let sheared = law.with_tangential_ratio(2.0 / 7.0).unwrap();
    assert!((sheared.tangential_stiffness(1.0) - 2e5 / 7.0).abs() < 1e-9);
}

#[test]
fn elastic_contact_time() {
    let law = Linear::from_restitution(1e5, 1.0, 4e-5).unwrap();
    let half_period = std::f64::consts::PI * (4e-5_f64 / 1e5).sqrt();
    assert!((law.contact_time(4e-5).unwrap() / half_period - 1.0).abs() < 1e-12);
    assert!(law.damping(0.0) < 1e-12);
}

#[test]
fn bad_parameters_are_named() {
    let bad = |k, e, m| Linear::from_restitution(k, e, m).unwrap_err().quantity;
    assert_eq!(bad(0.0, 0.5, 1.0), "stiffness");
    assert_eq!(bad(f64::NAN, 0.5, 1.0), "stiffness");
    assert_eq!(bad(1.0, 0.0, 1.0), "restitution");
    assert_eq!(bad(1.0, 1.5, 1.0), "restitution");
    assert_eq!(bad(1.0, 0.5, f64::INFINITY), "reduced mass");
    assert!(Linear::new(1.0, 1.0).unwrap().with_tangential_ratio(-1.0).is_err());
    assert_eq!(Linear::new(1.0, -1.0).unwrap_err().quantity, "damping");
}
