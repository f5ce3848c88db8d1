//! Particle steps per second on the settled beds that other DEM codes were measured on.

mod measure;
mod scene;

use std::io::{ErrorKind, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, ValueEnum};
use pendular::dem::{DVec3, Implicit};

/// Measures the speed of whole scenes.
///
/// Prints one line: `pendular SCENE THREADS PARTICLES STEPS SECONDS PARTICLE_STEPS_PER_S
/// PEAK_RSS_MB`, after a warm-up that is not counted.
#[derive(Debug, Parser)]
#[command(version)]
struct Cli {
    /// What to measure.
    #[arg(long)]
    scene: Scene,
    /// Settled spheres, CSV with the header `id,x,y,z,radius,density`, SI.
    #[arg(long, value_name = "FILE")]
    particles: PathBuf,
    /// Threads.
    #[arg(long, default_value_t = 1)]
    threads: usize,
    /// Timed steps.
    #[arg(long, default_value_t = 4000)]
    steps: u64,
    /// Steps before the timed ones.
    #[arg(long, default_value_t = 200)]
    warm: u64,
    /// Half side of the box of the beds, m; from the spheres where it is left out.
    #[arg(long)]
    half: Option<f64>,
    /// Puts copies of the bed side by side, so many along x and along y.
    #[arg(long, value_name = "NX,NY", value_delimiter = ',', num_args = 1, default_value = "1,1")]
    tile: Vec<u32>,
    /// Screen wires as prisms of triangles with this many sides instead of exact cylinders.
    #[arg(long, value_name = "SIDES")]
    mesh: Option<u32>,
    /// Solves for dashpots and drags at the end of the step (wet scenes).
    #[arg(long)]
    implicit: bool,
    /// Share of the impulses at which the passes of `--implicit` stop.
    #[arg(long, value_name = "SHARE")]
    pass_tolerance: Option<f64>,
    /// Viscosity of the liquid, Pa s.
    #[arg(long, default_value_t = scene::VISCOSITY)]
    viscosity: f64,
    /// Skin of the outer neighbour lists, m.
    #[arg(long)]
    skin: Option<f64>,
    /// Skin of the active lists, m.
    #[arg(long)]
    inner_skin: Option<f64>,
    /// Writes the final centres as CSV, `id,x,y,z` (m), ids counted from 0.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Also prints kinetic energy, mean overlap, mean coordination and where the time went.
    #[arg(long)]
    check: bool,
}

/// The scenes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Scene {
    /// Spheres in a box over a vibrating floor.
    DryBed,
    /// The same with liquid.
    WetBed,
    /// Spheres in a pipe over a vibrating screen of wires.
    DryScreen,
    /// The same with liquid.
    WetScreen,
}

impl Scene {
    fn is_wet(self) -> bool {
        matches!(self, Self::WetBed | Self::WetScreen)
    }

    fn has_screen(self) -> bool {
        matches!(self, Self::DryScreen | Self::WetScreen)
    }

    fn name(self) -> String {
        self.to_possible_value().map_or_else(String::new, |value| value.get_name().to_owned())
    }
}

fn main() -> ExitCode {
    let cli = Cli::parse();
    match run(&cli) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}

fn run(cli: &Cli) -> Result<(), Box<dyn std::error::Error>> {
    if cli.implicit && !cli.scene.is_wet() {
        return Err("--implicit needs a wet scene: allowed are wet-bed and wet-screen".into());
    }
    let bed = scene::Bed::read(&cli.particles)
        .map_err(|error| format!("{}: {error}", cli.particles.display()))?;
    let half = cli.half.unwrap_or(bed.half());
    let &[nx, ny] = cli.tile.as_slice() else {
        return Err(format!("--tile needs two numbers, got {:?}", cli.tile).into());
    };
    let tiled = (nx, ny) != (1, 1);
    if nx.checked_mul(ny).is_none_or(|copies| copies == 0) || (tiled && cli.scene.has_screen()) {
        return Err(
            "--tile needs two positive numbers, below 2^32 copies, and a bed in a box".into()
        );
    }
    let bed = if tiled { bed.tiled([nx, ny], half)? } else { bed };
    let sides = half * DVec3::new(f64::from(nx), f64::from(ny), 1.0);
    let walls = scene::walls(cli.scene.has_screen(), cli.mesh, sides)?;
    let mut settings = scene::settings(cli.threads);
    (settings.skin, settings.inner_skin) = (cli.skin, cli.inner_skin);
    settings.pass_tolerance = cli.pass_tolerance.unwrap_or(settings.pass_tolerance);
    let result = if cli.scene.is_wet() {
        let wet = scene::wet(&bed, &walls.0, cli.viscosity)?;
        let term = (scene::contact(bed.particles.classes())?, wet);
        if cli.implicit {
            let term = Implicit::new(term);
            measure::run(bed.particles, term, walls, settings, cli.warm, cli.steps)?
        } else {
            measure::run(bed.particles, term, walls, settings, cli.warm, cli.steps)?
        }
    } else {
        let term = scene::contact(bed.particles.classes())?;
        measure::run(bed.particles, term, walls, settings, cli.warm, cli.steps)?
    };
    let mut said = format!(
        "pendular {} {} {} {} {:.3} {:.4e} {:.1}\n",
        cli.scene.name(),
        cli.threads,
        result.particles,
        cli.steps,
        result.seconds,
        result.particles as f64 * cli.steps as f64 / result.seconds,
        result.memory
    );
    if let Some(path) = &cli.out {
        let failed = |error| format!("{}: {error}", path.display());
        std::fs::write(path, &result.centres).map_err(failed)?;
    }
    if cli.check {
        said += &format!("{}\n", result.check);
    }
    match std::io::stdout().write_all(said.as_bytes()) {
        // Whoever reads along may have had enough.
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(error.into()),
        _ => Ok(()),
    }
}
