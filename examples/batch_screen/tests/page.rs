//! Pages made from folders as runs leave them: whole, cut short, broken, hostile, large.

#![allow(clippy::unwrap_used, reason = "the helpers of tests may panic like the tests")]

#[allow(dead_code, reason = "pages are always replaced")]
#[path = "../src/replace.rs"]
mod replace;

#[path = "../src/page/mod.rs"]
mod page;

use std::fmt::Write;
use std::path::{Path, PathBuf};

use page::PageError;
use serde_json::{Value, json};
use tempfile::TempDir;

const RETAINED: &str = "time_s,total,5 mm,10 mm,particles_above\n\
                        0.000000,1,1,1,100\n0.500000,0.75,0.5,1,60\n1.000000,0.625,0.25,1,40\n";

fn put(folder: &Path, name: &str, text: &str) {
    std::fs::write(folder.join(name), text).unwrap();
}

/// The least that a page needs.
fn small() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let summary = json!({
        "title": "A small run",
        "classes": [
            { "name": "5 mm", "diameter_mm": 5.0, "count": 80 },
            { "name": "10 mm", "diameter_mm": 10.0, "count": 20 },
        ],
        "wall_time_s": 3.5,
    });
    put(folder.path(), "summary.json", &summary.to_string());
    put(folder.path(), "retained.csv", RETAINED);
    folder
}

/// Everything a run can leave.
fn whole() -> TempDir {
    let folder = small();
    let put = |name: &str, text: &str| put(folder.path(), name, text);
    put(
        "liquid.csv",
        "time_s,above 5 mm [m3],above 10 mm [m3],fines 5 mm [m3],fines 10 mm [m3],wires [m3],bridges [m3],total [m3]\n\
         0,1e-6,1e-6,0,0,0,0,2e-6\n1,5e-7,9e-7,3e-7,0,1e-7,2e-7,2e-6\n",
    );
    put(
        "bridges.csv",
        "time_s,formed,ruptured,alive,alive_wall,mean_v_star,extrapolated\n0,0,0,0,0,0,0\n1,50,20,30,4,0.01,2\n",
    );
    put("partition.csv", "time_s,5 mm,10 mm,cut_size_mm,imperfection\n0,0,0,,\n1,0.75,0,6.5,0.2\n");
    put("pegging.csv", "time_s,apertures,blocked,5 mm,10 mm\n0,64,0,0,0\n1,64,3,0,3\n");
    put(
        "liquid_final.csv",
        "division,place,volume_m3,in_bridges_m3,share\nfines,5 mm,1e-6,0,0.5\nall,all,2e-6,2e-7,1\n",
    );
    put("energy.csv", "time_s,kinetic_J,potential_J\n0,0.1,0.2\n1,0.05,0.1\n");
    put(
        "scene.toml",
        "time = 1.0\n[[classes]]\ncount = 80\n[motion]\namplitude_mm = [0, 0, 1.5]\n",
    );
    put(
        "passages.csv",
        "time_s,id,class,diameter_m,film_m3,x_m,y_m\n0.25,3,5 mm,0.005,1e-9,0.01,-0.02\n",
    );
    put(
        "replay.csv",
        "time_s,id,class,x_m,y_m,z_m,film_m\n0,0,0,0.01,0.02,0.03,1e-5\n0,1,1,-0.01,0,0.03,2e-5\n1,1,1,0,0,0.01,1e-5\n",
    );
    folder
}

/// The page's text, and its data as its program reads them.
fn open(path: &Path) -> (String, Value) {
    let text = std::fs::read_to_string(path).unwrap();
    let (_, after) = text.split_once("<script type=\"application/json\" id=\"data\">").unwrap();
    let data = serde_json::from_str(after.split_once("</script>").unwrap().0).unwrap();
    (text, data)
}

fn report(folder: &TempDir) -> (String, Value) {
    let path = page::report(folder.path()).unwrap();
    assert_eq!(path, folder.path().join("report.html"));
    open(&path)
}

/// A column of a packed table.
fn column(table: &Value, name: &str) -> Vec<f32> {
    let digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let text = table["data"].as_str().unwrap();
    let digit = |c| digits.find(c).map(|k| k as u32);
    let sixes: Vec<u32> = text.chars().filter_map(digit).collect();
    let bits: Vec<u32> = sixes.iter().flat_map(|v| (0..6).map(move |k| v >> (5 - k) & 1)).collect();
    let bytes: Vec<u8> =
        bits.chunks_exact(8).map(|b| b.iter().fold(0, |w, bit| w << 1 | *bit as u8)).collect();
    let floats: Vec<f32> =
        bytes.chunks_exact(4).map(|b| f32::from_le_bytes(b.try_into().unwrap())).collect();
    let names = table["names"].as_array().unwrap();
    let rows = table["rows"].as_u64().unwrap() as usize;
    assert_eq!(floats.len(), rows * names.len());
    let k = names.iter().position(|known| known == name).expect(name);
    floats[k * rows..(k + 1) * rows].to_vec()
}

#[test]
fn a_page_holds_what_the_folder_holds() {
    let (text, data) = report(&whole());
    assert!(text.starts_with("<!doctype html>") && text.ends_with("</html>\n"));
    assert!(text.contains("<title>A small run</title>"));
    let run = &data["runs"][0];
    assert_eq!(run["classes"][1], json!({ "name": "10 mm", "diameter_mm": 10.0 }));
    assert_eq!(run["notes"], json!([]));
    let tables = &run["tables"];
    assert_eq!(column(&tables["retained"], "5 mm"), [1.0, 0.5, 0.25]);
    assert_eq!(column(&tables["retained"], "particles_above"), [100.0, 60.0, 40.0]);
    assert_eq!(column(&tables["liquid"], "bridges [m3]"), [0.0, 2e-7]);
    assert_eq!(column(&tables["bridges"], "alive_wall"), [0.0, 4.0]);
    let cut = column(&tables["partition"], "cut_size_mm");
    assert!(cut[0].is_nan() && cut[1] == 6.5);
    assert_eq!(column(&tables["pegging"], "blocked"), [0.0, 3.0]);
    assert_eq!(column(&tables["energy"], "potential_J"), [0.2, 0.1]);
    assert_eq!(column(&tables["passages"], "class"), [0.0]);
    assert_eq!(run["liquid_final"][0], json!(["fines", "5 mm", 1e-6, 0.0, 0.5]));
    let scene =
        json!([["classes[0].count", 80], ["motion.amplitude_mm", [0, 0, 1.5]], ["time", 1.0]]);
    assert_eq!(run["scene"], scene);
    let frames = &run["replay"]["frames"];
    assert_eq!(
        *frames,
        json!([{ "time": 0.0, "counts": [1, 1] }, { "time": 1.0, "counts": [0, 1] }])
    );
}

#[test]
fn a_page_needs_nothing_from_outside() {
    let (text, _) = report(&whole());
    let free = text.replace("http://www.w3.org/2000/svg", "");
    for outside in
        ["http:", "https:", "//cdn", "<link", "<img", "<iframe", " src=", "@import", "@font-face"]
    {
        assert!(!free.contains(outside), "{outside}");
    }
    assert_eq!(free.matches("url(").count(), free.matches("url(#").count());
    assert!(text.contains("default-src 'none'"));
}

#[test]
fn absent_files_leave_their_section_out() {
    let (_, data) = report(&small());
    let run = &data["runs"][0];
    assert_eq!(run["tables"].as_object().unwrap().keys().collect::<Vec<_>>(), ["retained"]);
    assert!(run["replay"].is_null());
    assert_eq!(run["liquid_final"], json!([]));
    assert!(run["scene"].is_null(), "of an older run");
    // Without the summary's classes diameters come from the passages, or are not known.
    let folder = whole();
    put(folder.path(), "summary.json", "{}");
    let (text, data) = report(&folder);
    assert_eq!(data["runs"][0]["classes"][0]["diameter_mm"].as_f64(), Some(5.0));
    assert!(data["runs"][0]["classes"][1]["diameter_mm"].is_null());
    let name = folder.path().file_name().unwrap().to_str().unwrap();
    assert!(text.contains(&format!("<title>{name}</title>")));
}

#[test]
fn needed_files_and_folders_are_asked_for_by_name() {
    for name in ["summary.json", "retained.csv"] {
        let folder = small();
        std::fs::remove_file(folder.path().join(name)).unwrap();
        let error = page::report(folder.path()).unwrap_err();
        assert!(matches!(error, PageError::Read { .. }));
        assert!(error.to_string().contains(name), "{error}");
        assert!(!folder.path().join("report.html").exists());
    }
    let nowhere = Path::new("no/such/folder");
    assert!(matches!(page::report(nowhere), Err(PageError::Read { .. })));
    let folder = small();
    let out = folder.path().join("no/such/page.html");
    let error = page::compare(&[folder.path().to_path_buf()], &out).unwrap_err();
    assert!(matches!(error, PageError::Write { .. }));
    assert!(matches!(page::compare(&[], &out), Err(PageError::Nothing)));
}

#[test]
fn a_killed_run_shows_its_whole_rows() {
    let folder = whole();
    put(folder.path(), "retained.csv", &format!("{RETAINED}1.500000,0.5,0.1,1,2"));
    put(folder.path(), "energy.csv", "time_s,kinetic_J\n");
    put(folder.path(), "scene.toml", "time = ");
    let (_, data) = report(&folder);
    let run = &data["runs"][0];
    assert_eq!(column(&run["tables"]["retained"], "time_s"), [0.0, 0.5, 1.0]);
    assert_eq!(run["tables"]["energy"]["rows"], 0);
    assert_eq!(
        run["notes"],
        json!([
            "scene.toml is no TOML and was left out.",
            "The last line of retained.csv is not whole and was left out."
        ])
    );
    // Cut at any byte after the header, it still makes a page.
    let head = RETAINED.find('\n').unwrap() + 1;
    for end in head..RETAINED.len() {
        put(folder.path(), "retained.csv", &RETAINED[..end]);
        let (_, data) = report(&folder);
        let rows = RETAINED[head..end].matches('\n').count();
        assert_eq!(data["runs"][0]["tables"]["retained"]["rows"], rows, "{end}");
    }
}

#[test]
fn broken_files_are_told_with_file_and_line_and_leave_the_page_alone() {
    let cases = [
        ("summary.json", "{\n\"title\": \"x\",\n}", "summary.json, line 3, column 1: not JSON"),
        ("summary.json", "[1]", "summary.json, line 1: allowed: an object, found a list"),
        ("summary.json", "", "summary.json, line 1, column 0: not JSON"),
        ("retained.csv", "a,b,c\n", "retained.csv, line 1: the header; allowed: time_s,total,"),
        ("retained.csv", "", "retained.csv, line 1: no header"),
        ("liquid.csv", "t,x\n0,1\n", "liquid.csv, line 1: no column `time_s`"),
        ("energy.csv", "time_s,e\n0,1\n1\n2,3\n", "energy.csv, line 3: 1 cells; allowed: 2"),
        ("pegging.csv", "time_s,e\n0,many\n", "pegging.csv, line 2: `many` in column `e`"),
        (
            "passages.csv",
            "time_s,class\n0,6 mm\n",
            "passages.csv, line 2: class `6 mm`; allowed: 5 mm, 10 mm",
        ),
        ("replay.csv", "time_s,id\n0,1\n", "replay.csv, line 1: no column `class`"),
        (
            "replay.csv",
            "time_s,class,x_m,y_m,z_m,film_m\n0,0,0,0,nan,0\n",
            "replay.csv, line 2: `nan` in column `z_m`",
        ),
    ];
    for (name, text, told) in cases {
        let folder = whole();
        put(folder.path(), "report.html", "the page of before");
        put(folder.path(), name, text);
        let error = page::report(folder.path()).unwrap_err().to_string();
        assert!(error.contains(told), "{error}");
        let page = std::fs::read_to_string(folder.path().join("report.html")).unwrap();
        assert_eq!(page, "the page of before");
    }
    let folder = whole();
    std::fs::write(folder.path().join("bridges.csv"), b"time_s,x\n0,1\n1,\xff\n").unwrap();
    let error = page::report(folder.path()).unwrap_err().to_string();
    assert!(error.contains("bridges.csv, line 3: not UTF-8"), "{error}");
}

#[test]
fn no_text_of_a_file_becomes_markup() {
    let folder = tempfile::tempdir().unwrap();
    let evil = "</script><script>alert(1)</script><img src=x onerror=alert(2)>";
    let summary =
        json!({ "title": format!("{evil}&'\""), "assumptions": { evil: evil }, "scene": evil });
    put(folder.path(), "summary.json", &summary.to_string());
    put(
        folder.path(),
        "retained.csv",
        &format!("time_s,total,{evil},particles_above\n0,1,1,4\n1,1,1,3\n"),
    );
    let (text, data) = report(&folder);
    assert_eq!((text.matches("<script").count(), text.matches("</script").count()), (2, 2));
    assert!(!text.contains("<img"));
    assert!(text.contains("<title>&lt;/script&gt;&lt;script&gt;"));
    assert_eq!(data["runs"][0]["classes"][0]["name"], evil);
    assert_eq!(data["runs"][0]["summary"]["assumptions"][evil], evil);
}

#[test]
fn a_large_run_stays_a_small_page_and_says_so() {
    let folder = small();
    let mut rows = String::from("time_s,id,class,x_m,y_m,z_m,film_m\n");
    let (moments, particles) = (70, 20_000);
    for t in 0..moments {
        for k in 0..particles {
            writeln!(rows, "{t},{k},{},{k}e-6,{t}e-3,0.1,1e-5", k % 2).unwrap();
        }
    }
    put(folder.path(), "replay.csv", &rows);
    let long: String = (0..20_000).map(|t| format!("{t},1,2\n")).collect();
    put(folder.path(), "energy.csv", &format!("time_s,kinetic_J,potential_J\n{long}"));
    let (text, data) = report(&folder);
    assert!(text.len() < 12_000_000 && text.len() > 11_000_000, "{}", text.len());
    let run = &data["runs"][0];
    let frames = run["replay"]["frames"].as_array().unwrap();
    assert!(frames.len() < moments);
    assert_eq!(
        (frames[0]["time"].as_f64(), frames[frames.len() - 1]["time"].as_f64()),
        (Some(0.0), Some(69.0))
    );
    assert_eq!(frames[7]["counts"], json!([10_000, 10_000]));
    let notes = run["notes"].as_array().unwrap();
    assert_eq!(notes[0], "energy.csv has 20000 rows, of which 2858 are on this page.");
    let told = format!("The replay shows {} of the 70 moments of replay.csv", frames.len());
    assert!(notes[1].as_str().unwrap().starts_with(&told), "{notes:?}");
    let times = column(&run["tables"]["energy"], "time_s");
    assert_eq!((times[0], times[1], times[times.len() - 1]), (0.0, 7.0, 19_999.0));
}

#[test]
fn a_comparison_holds_every_run_and_tells_same_names_apart() {
    let above = tempfile::tempdir().unwrap();
    let mut folders: Vec<PathBuf> = Vec::new();
    for place in ["one/run", "two/run", "other"] {
        let folder = above.path().join(place);
        std::fs::create_dir_all(&folder).unwrap();
        for entry in std::fs::read_dir(whole().path()).unwrap() {
            let entry = entry.unwrap();
            std::fs::copy(entry.path(), folder.join(entry.file_name())).unwrap();
        }
        folders.push(folder);
    }
    let out = above.path().join("compare.html");
    page::compare(&folders, &out).unwrap();
    let (text, data) = open(&out);
    assert!(text.contains("<title>Comparison of 3 runs</title>"));
    let names: Vec<&str> =
        data["runs"].as_array().unwrap().iter().map(|run| run["name"].as_str().unwrap()).collect();
    assert_eq!(names, [folders[0].to_str().unwrap(), folders[1].to_str().unwrap(), "other"]);
    let run = &data["runs"][1];
    assert_eq!(column(&run["tables"]["retained"], "total"), [1.0, 0.75, 0.625]);
    assert!(run["replay"].is_null() && run["tables"]["passages"].is_null());
    assert!(!run["tables"]["partition"].is_null());
}

#[test]
fn a_drawing_shows_a_column_of_every_run() {
    let (first, second) = (whole(), small());
    let folders = [first.path().to_path_buf(), second.path().to_path_buf()];
    let out = first.path().join("y.svg");
    page::drawing(&folders, "5 mm", &out).unwrap();
    let text = std::fs::read_to_string(&out).unwrap();
    assert!(text.starts_with("<svg ") && text.contains("retained of 5 mm, %"));
    // 1, 0.5 and 0.25 at the start, the middle and the end of both runs.
    assert_eq!(text.matches("d=\"M58.0 16.0L339.0 204.0L620.0 298.0\"").count(), 2, "{text}");
    for folder in &folders {
        assert!(text.contains(folder.file_name().unwrap().to_str().unwrap()));
    }
    let said = page::drawing(&folders, "6 mm", &out).unwrap_err().to_string();
    assert!(said.contains("`6 mm`") && said.contains("total, 5 mm, 10 mm"), "{said}");
    assert!(matches!(page::drawing(&[], "total", &out), Err(PageError::Nothing)));
}

#[test]
fn the_same_folder_gives_the_same_page() {
    let folder = whole();
    let (first, _) = report(&folder);
    assert!(first == report(&folder).0);
    assert!(!folder.path().join("report.html.part").exists());
}
