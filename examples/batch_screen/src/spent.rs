//! Where the time of a run went.

use std::time::Duration;

use pendular::dem::Profile;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

/// Wall time by what it was for; parallel parts are summed over the threads.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
pub(crate) struct Spent {
    neighbours: Duration,
    pairs: Duration,
    walls: Duration,
    bridges: Duration,
    /// Implicit drags.
    resistance: Duration,
    integration: Duration,
    pub(crate) output: Duration,
}

impl Spent {
    /// The same with what a simulation has spent since it was set up.
    pub(crate) fn with(self, profile: &Profile) -> Self {
        Self {
            neighbours: self.neighbours + profile.neighbours,
            pairs: self.pairs + profile.pairs,
            walls: self.walls + profile.walls,
            bridges: self.bridges + profile.settling,
            resistance: self.resistance + profile.resistance,
            integration: self.integration + profile.integration,
            output: self.output,
        }
    }

    /// Of implicit drags only where there are any.
    fn parts(&self) -> Vec<(&'static str, f64)> {
        let all = [
            ("neighbours", self.neighbours),
            ("pairs", self.pairs),
            ("walls", self.walls),
            ("bridges", self.bridges),
            ("resistance", self.resistance),
            ("integration", self.integration),
            ("output", self.output),
        ];
        let told = all.into_iter().filter(|(name, time)| *name != "resistance" || !time.is_zero());
        told.map(|(name, time)| (name, time.as_secs_f64())).collect()
    }

    fn shares(&self) -> Vec<(&'static str, f64)> {
        let all: f64 = self.parts().iter().map(|(_, seconds)| seconds).sum();
        let share = |seconds: f64| if all > 0.0 { 100.0 * seconds / all } else { 0.0 };
        self.parts().into_iter().map(|(name, seconds)| (name, share(seconds))).collect()
    }

    /// Seconds by name.
    pub(crate) fn seconds(&self) -> Map<String, Value> {
        let one = |(name, seconds): (&str, f64)| (name.to_owned(), json!(seconds));
        self.parts().into_iter().map(one).collect()
    }

    /// Percent of the sum by name.
    pub(crate) fn percent(&self) -> Map<String, Value> {
        let one = |(name, share): (&str, f64)| (name.to_owned(), json!(share));
        self.shares().into_iter().map(one).collect()
    }

    /// One line for people.
    pub(crate) fn line(&self) -> String {
        let one = |(name, share)| format!("{name} {share:.0} %");
        let told: Vec<String> = self.shares().into_iter().map(one).collect();
        format!("wall time: {}", told.join(", "))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_make_a_whole() {
        let second = Duration::from_secs(1);
        let profile = Profile { pairs: second, walls: 2 * second, ..Profile::default() };
        let spent = Spent { output: second, ..Spent::default() }.with(&profile);
        let percent = spent.percent();
        assert_eq!(percent["walls"], 50.0);
        let all: f64 = percent.values().filter_map(Value::as_f64).sum();
        assert!((all - 100.0).abs() < 1e-12);
        assert!(spent.line().contains("output 25 %"));
    }
}
