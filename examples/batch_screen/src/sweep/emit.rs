//! The commands of a sweep, for a cluster or another runner of jobs.

use std::path::Path;

use super::plan::Plan;
use crate::cli::SweepArgs;

/// A word that a shell takes as it is.
fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "_-./=,+:@%".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        return word.to_owned();
    }
    format!("'{}'", word.replace('\'', r"'\''"))
}

/// A name that SLURM takes as it is, also in the names of files: no quotes, no `%`.
fn job_name(name: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "_-.".contains(c);
    name.chars().map(|c| if plain(c) { c } else { '_' }).collect()
}

fn program() -> String {
    let own = std::env::current_exe().unwrap_or_else(|_| "batch_screen".into());
    quoted(&own.to_string_lossy())
}

fn words(args: &SweepArgs, out: &Path, only: &str, threads: &str) -> String {
    let (file, out) = (quoted(&args.file.to_string_lossy()), quoted(&out.to_string_lossy()));
    let mut text = format!("sweep {file} --out {out} --only {only} --threads {threads}");
    if let Some(beds) = &args.beds {
        text += &format!(" --beds {}", quoted(&beds.to_string_lossy()));
    }
    text + &format!(" --checkpoint-every {} --quiet", args.how.checkpoint_every)
}

/// One command a line.
pub(crate) fn list(plan: &Plan, args: &SweepArgs, out: &Path, threads: usize) -> String {
    let line = |k: usize| {
        format!("{} {}\n", program(), words(args, out, &k.to_string(), &threads.to_string()))
    };
    (1..=plan.runs.len()).map(line).collect()
}

/// A script for `sbatch`.
pub(crate) fn slurm(plan: &Plan, args: &SweepArgs, out: &Path, threads: usize) -> String {
    let runs = plan.runs.len();
    let at_once = if args.jobs > 1 { format!("%{}", args.jobs) } else { String::new() };
    let command = words(args, out, "\"$SLURM_ARRAY_TASK_ID\"", "\"$SLURM_CPUS_PER_TASK\"");
    let (file, folder) = (quoted(&args.file.to_string_lossy()), quoted(&out.to_string_lossy()));
    format!(
        "#!/bin/bash\n\
         # {runs} runs of {name}, one task each: sbatch this file from the folder it was made in.\n\
         # A task that is stopped or requeued goes on from its last checkpoint. The table is made\n\
         # of what there is by: {program} sweep {file} --out {folder} --gather\n\
         #SBATCH --job-name={name}\n\
         #SBATCH --array=1-{runs}{at_once}\n\
         #SBATCH --ntasks=1\n\
         #SBATCH --cpus-per-task={threads}\n\
         #SBATCH --time=24:00:00\n\
         #SBATCH --signal=B:TERM@120\n\
         #SBATCH --requeue\n\
         #SBATCH --output={name}-%A_%a.log\n\
         exec {program} {command}\n",
        name = job_name(&plan.name),
        program = program(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_name_of_a_job_is_plain() {
        assert_eq!(job_name("it's 5 %\u{e9}-a_b.2"), "it_s_5___-a_b.2");
    }

    #[test]
    fn words_survive_a_shell() {
        for word in ["plain/path-1.toml", "with space", "it's", "$HOME; rm", ""] {
            let command = format!("printf %s {}", quoted(word));
            let out = std::process::Command::new("sh").args(["-c", &command]).output().unwrap();
            assert_eq!(String::from_utf8(out.stdout).unwrap(), word);
        }
    }
}
