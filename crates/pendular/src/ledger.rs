use crate::room::make_room;

/// Where liquid can be.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Account {
    /// The film on a particle, by its id.
    Film(u32),
    /// The film on a wall element, numbered through all parts.
    Wall(u32),
    /// A live bridge.
    Bridge(u32),
    /// Liquid that left the scene with its particle.
    Drained,
}

/// A volume, m³, that goes from one account to another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Move {
    /// Who gives.
    pub from: Account,
    /// Who takes.
    pub to: Account,
    /// How much, m³, at least 0.
    pub volume: f64,
}

/// A move that cannot be booked.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "cannot book {} m^3 from {:?} to {:?}: both accounts must exist and the volume be finite and \
     not negative", .0.volume, .0.from, .0.to
)]
pub struct BadMove(pub Move);

/// A [`Ledger`] as plain numbers, to be stored.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LedgerParts {
    /// Films on the particles by id, m³.
    pub films: Vec<f64>,
    /// Films on the wall elements, m³.
    pub walls: Vec<f64>,
    /// Bridges by account, m³.
    pub bridges: Vec<f64>,
    /// Bridge accounts that are closed.
    pub free: Vec<u32>,
    /// Volume that left the scene, m³.
    pub drained: f64,
    /// Volume at the start, m³.
    pub initial: f64,
}

/// The account of all liquid in a scene, m³.
///
/// Volumes change in [`Ledger::book`] alone. Whatever is booked, no account becomes negative and
/// the total stays what it was, to rounding.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Ledger {
    films: Vec<f64>,
    walls: Vec<f64>,
    bridges: Vec<f64>,
    drained: f64,
    free: Vec<u32>,
    initial: f64,
}

impl Ledger {
    /// A ledger with the given films on particles (by id) and dry walls of `elements` elements.
    #[must_use]
    pub fn new(films: Vec<f64>, elements: usize) -> Self {
        let mut ledger = Self { films, walls: vec![0.0; elements], ..Self::default() };
        ledger.initial = ledger.total();
        ledger
    }

    /// A ledger as plain numbers: films, walls, bridges, closed bridge accounts, and the drained and
    /// initial volume, m³.
    #[must_use]
    pub fn parts(&self) -> LedgerParts {
        let (films, walls, bridges) =
            (self.films.clone(), self.walls.clone(), self.bridges.clone());
        let (drained, initial) = (self.drained, self.initial);
        LedgerParts { films, walls, bridges, free: self.free.clone(), drained, initial }
    }

    /// The ledger of such numbers.
    #[must_use]
    pub fn from_parts(parts: LedgerParts) -> Self {
        let LedgerParts { films, walls, bridges, free, drained, initial } = parts;
        Self { films, walls, bridges, drained, free, initial }
    }

    /// Volume of an account, m³; 0 for one that does not exist.
    #[must_use]
    pub fn volume(&self, account: Account) -> f64 {
        let at = |column: &[f64], k: u32| column.get(k as usize).copied().unwrap_or(0.0);
        match account {
            Account::Film(k) => at(&self.films, k),
            Account::Wall(k) => at(&self.walls, k),
            Account::Bridge(k) => at(&self.bridges, k),
            Account::Drained => self.drained,
        }
    }

    /// Films on the particles by id, m³.
    #[must_use]
    pub fn films(&self) -> &[f64] {
        &self.films
    }

    /// Films on the wall elements, numbered through all parts, m³.
    #[must_use]
    pub fn walls(&self) -> &[f64] {
        &self.walls
    }

    /// Volume in all live bridges, m³.
    #[must_use]
    pub fn in_bridges(&self) -> f64 {
        self.bridges.iter().sum()
    }

    /// Volume that left the scene, m³.
    #[must_use]
    pub fn drained(&self) -> f64 {
        self.drained
    }

    /// All liquid there is, m³.
    #[must_use]
    pub fn total(&self) -> f64 {
        let sum = |column: &[f64]| column.iter().sum::<f64>();
        sum(&self.films) + sum(&self.walls) + sum(&self.bridges) + self.drained
    }

    /// (total − initial total)/initial total: what rounding has gained or lost. 0 without liquid.
    #[must_use]
    pub fn imbalance(&self) -> f64 {
        if self.initial == 0.0 {
            self.total()
        } else {
            (self.total() - self.initial) / self.initial
        }
    }

    /// Makes room for so many more bridges.
    pub fn reserve(&mut self, bridges: usize) {
        make_room(&mut self.bridges, bridges.saturating_sub(self.free.len()));
    }

    /// How many bridge accounts there are, open or closed.
    #[must_use]
    pub fn bridges(&self) -> usize {
        self.bridges.len()
    }

    /// An empty account for a new bridge.
    pub fn open_bridge(&mut self) -> u32 {
        self.free.pop().unwrap_or_else(|| {
            self.bridges.push(0.0);
            (self.bridges.len() - 1) as u32
        })
    }

    /// Closes an emptied bridge account; its number may be given out again. What rounding has left
    /// in it, if anything, goes into the next bridge of that number: it is never dropped.
    pub fn close_bridge(&mut self, bridge: u32) {
        let rest = self.volume(Account::Bridge(bridge));
        debug_assert!(rest <= 1e-12 * self.initial.max(f64::MIN_POSITIVE), "{rest:e} m3 are left");
        self.free.push(bridge);
    }

    /// Carries out all moves at once, as one state after another.
    ///
    /// Where the moves out of an account exceed what it holds, they are scaled down in proportion.
    /// `moves` holds what was moved afterwards.
    ///
    /// # Errors
    /// [`BadMove`] for a volume that is negative or not finite, or an account that does not exist;
    /// nothing is moved then.
    pub fn book(&mut self, moves: &mut [Move]) -> Result<(), BadMove> {
        let fits = |step: &Move| {
            let volume = step.volume >= 0.0 && step.volume.is_finite();
            volume && self.exists(step.from) && self.exists(step.to)
        };
        if let Some(step) = moves.iter().find(|step| !fits(step)) {
            return Err(BadMove(*step));
        }
        let mut order: Vec<u32> = (0..moves.len() as u32).collect();
        order.sort_unstable_by_key(|&k| (moves[k as usize].from, k));
        let mut rest = &order[..];
        while let Some(&first) = rest.first() {
            let from = moves[first as usize].from;
            let same = rest.iter().take_while(|&&k| moves[k as usize].from == from).count();
            let (group, others) = rest.split_at(same);
            self.give(moves, group);
            rest = others;
        }
        for step in moves.iter() {
            *self.entry(step.to) += step.volume;
        }
        Ok(())
    }

    /// Takes the moves of `group` out of the one account that they come from.
    fn give(&mut self, moves: &mut [Move], group: &[u32]) {
        let from = moves[group[0] as usize].from;
        let has = self.volume(from);
        let sum = |moves: &[Move]| group.iter().map(|&k| moves[k as usize].volume).sum::<f64>();
        let asked = sum(moves);
        if asked > has {
            let scale = has / asked;
            group.iter().for_each(|&k| moves[k as usize].volume *= scale);
        }
        let given = sum(moves);
        // Rounding may ask for a last bit more or less than all: then the account is empty.
        let left = has - given;
        *self.entry(from) = if left > f64::EPSILON * has { left } else { 0.0 };
    }

    fn exists(&self, account: Account) -> bool {
        match account {
            Account::Film(k) => (k as usize) < self.films.len(),
            Account::Wall(k) => (k as usize) < self.walls.len(),
            Account::Bridge(k) => (k as usize) < self.bridges.len(),
            Account::Drained => true,
        }
    }

    fn entry(&mut self, account: Account) -> &mut f64 {
        match account {
            Account::Film(k) => &mut self.films[k as usize],
            Account::Wall(k) => &mut self.walls[k as usize],
            Account::Bridge(k) => &mut self.bridges[k as usize],
            Account::Drained => &mut self.drained,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn film(from: u32, bridge: u32, volume: f64) -> Move {
        Move { from: Account::Film(from), to: Account::Bridge(bridge), volume }
    }

    #[test]
    fn overdrawn_claims_are_scaled_in_proportion() {
        let mut ledger = Ledger::new(vec![1.0, 1.0], 0);
        let (a, b) = (ledger.open_bridge(), ledger.open_bridge());
        let mut moves = [film(0, a, 1.5), film(1, a, 0.5), film(0, b, 0.5)];
        ledger.book(&mut moves).unwrap();
        assert_eq!([moves[0].volume, moves[1].volume, moves[2].volume], [0.75, 0.5, 0.25]);
        assert_eq!(ledger.films(), [0.0, 0.5]);
        assert_eq!(ledger.volume(Account::Bridge(a)), 1.25);
    }

    #[test]
    fn what_comes_in_a_step_cannot_be_given_in_it() {
        let mut ledger = Ledger::new(vec![1.0, 0.0], 0);
        let (a, b) = (ledger.open_bridge(), ledger.open_bridge());
        ledger.book(&mut [film(0, a, 1.0)]).unwrap();
        let back = Move { from: Account::Bridge(a), to: Account::Film(1), volume: 1.0 };
        ledger.book(&mut [back, film(1, b, 1.0)]).unwrap();
        assert_eq!(ledger.films(), [0.0, 1.0]);
        assert_eq!(ledger.volume(Account::Bridge(b)), 0.0);
    }

    /// V T + (V − V T) may be a last bit away from V.
    #[test]
    fn shares_of_all_there_is_leave_nothing() {
        for k in 1..20_000 {
            let volume = 1e-10 / f64::from(k);
            let mut ledger = Ledger::new(vec![volume, 0.0], 0);
            let bridge = ledger.open_bridge();
            ledger.book(&mut [film(0, bridge, volume)]).unwrap();
            let first = volume * 0.317;
            let back =
                |to, volume| Move { from: Account::Bridge(bridge), to: Account::Film(to), volume };
            ledger.book(&mut [back(0, first), back(1, volume - first)]).unwrap();
            assert_eq!(ledger.in_bridges(), 0.0);
        }
    }

    #[test]
    fn bad_moves_are_refused_and_change_nothing() {
        let mut ledger = Ledger::new(vec![1.0], 1);
        let wall = |from, volume| Move { from, to: Account::Wall(0), volume };
        for bad in [
            wall(Account::Film(0), -1.0),
            wall(Account::Film(0), f64::NAN),
            wall(Account::Film(1), 0.5),
            Move { from: Account::Film(0), to: Account::Bridge(0), volume: 0.5 },
        ] {
            let good = wall(Account::Film(0), 0.5);
            let error = ledger.book(&mut [good, bad]).unwrap_err();
            assert!(error.to_string().contains("cannot book"), "{error}");
            assert_eq!((ledger.films(), ledger.walls()), (&[1.0][..], &[0.0][..]));
        }
    }

    proptest! {
        #[test]
        fn nothing_is_lost_and_nothing_negative(
            steps in proptest::collection::vec(
                proptest::collection::vec((0u32..6, 0u32..6, 0.0..2.0f64), 1..8), 1..200)
        ) {
            let account = |k: u32| match k {
                0..3 => Account::Film(k),
                3..5 => Account::Wall(k - 3),
                _ => Account::Drained,
            };
            let mut ledger = Ledger::new(vec![1.0, 2.0, 0.5], 2);
            for step in steps {
                let mut moves: Vec<Move> = step
                    .into_iter()
                    .map(|(a, b, volume)| Move { from: account(a), to: account(b), volume })
                    .collect();
                ledger.book(&mut moves).unwrap();
                let all = ledger.films().iter().chain(ledger.walls());
                prop_assert!(all.chain([&ledger.drained]).all(|&v| v >= 0.0));
            }
            prop_assert!(ledger.imbalance().abs() < 1e-13);
        }
    }
}
