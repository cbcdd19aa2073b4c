//! Tables in Markdown, and the same figures in JSON.

use crate::Args;
use crate::contestant::Contestant;
use crate::embree::{Embree, EmbreeScene};
use crate::measure::measure;
use crate::meshes;
use crate::ours::Ours;
use crate::rays::ray_sets;
use crate::theirs::{Obvhs, PRESETS};
use heliostat_geometry::TriMesh;
use heliostat_index::Backend;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::io::Write;
use std::rc::Rc;

/// One line on standard output; a closed pipe is no reason to stop.
fn line(text: &str) {
    let _ = writeln!(std::io::stdout(), "{text}");
}

/// Does what the command line asks for.
pub(crate) fn run(args: &Args) -> Result<(), String> {
    let embree = args
        .embree
        .as_ref()
        .map(|path| {
            let threads = std::thread::available_parallelism().map_or(1, usize::from);
            let config = if args.embree_config.is_empty() {
                String::new()
            } else {
                format!(",{}", args.embree_config)
            };
            Embree::open(path, threads, &config)
        })
        .transpose()?;
    let mut named: Vec<(String, TriMesh)> = Vec::new();
    if let Some(folder) = &args.meshes {
        for path in
            meshes::obj_files(folder)?.into_iter().filter(|p| p.to_string_lossy().contains(&args.only))
        {
            let name = path.strip_prefix(folder).unwrap_or(&path).display().to_string();
            named.push((name, meshes::load(&path)?));
        }
    }
    named.extend(args.generated.iter().map(|&n| (format!("dented sphere {n}"), meshes::dented_sphere(n))));
    named.retain(|(_, mesh)| mesh.triangles.len() >= args.least.max(1));

    let mut rows = Vec::new();
    let mut ratios: BTreeMap<(&'static str, String), Vec<f64>> = BTreeMap::new();
    for (name, mesh) in &named {
        compare(args, embree.as_ref(), name, mesh, &mut rows, &mut ratios)?;
    }
    means(&ratios);
    if let Some(path) = &args.json {
        let text = format!("{:#}\n", Value::Array(rows));
        std::fs::write(path, text).map_err(|e| format!("{}: {e}", path.display()))?;
    }
    growth(args, embree.as_ref())
}

/// All who take part, ours first.
fn contestants(
    args: &Args,
    embree: Option<&Rc<Embree>>,
    mesh: &TriMesh,
) -> Result<Vec<Box<dyn Contestant>>, String> {
    let backend = args
        .backend
        .as_ref()
        .map(|name| {
            let found = Backend::available().into_iter().find(|b| b.name() == name);
            found.ok_or_else(|| format!("no back end `{name}` on this processor"))
        })
        .transpose()?;
    let mut all: Vec<Box<dyn Contestant>> = Vec::new();
    for preset in &args.presets {
        all.push(Box::new(Ours::build(mesh, preset, backend)?));
    }
    for preset in PRESETS.into_iter().filter(|preset| args.obvhs.iter().any(|wanted| wanted == preset)) {
        all.push(Box::new(Obvhs::build(mesh, true, preset)));
        all.push(Box::new(Obvhs::build(mesh, false, preset)));
    }
    if let Some(embree) = embree {
        for robust in [false, true] {
            all.push(Box::new(EmbreeScene::build(embree, mesh, robust)?));
        }
    }
    Ok(all)
}

/// One mesh: a table of million rays per second, and ours over each of the others.
fn compare(
    args: &Args,
    embree: Option<&Rc<Embree>>,
    name: &str,
    mesh: &TriMesh,
    rows: &mut Vec<Value>,
    ratios: &mut BTreeMap<(&'static str, String), Vec<f64>>,
) -> Result<(), String> {
    let all = contestants(args, embree, mesh)?;
    let tree = Ours::build(mesh, &args.presets[0], None)?.tree;
    let stats = tree.stats();
    let sets = ray_sets(mesh, &tree, args.size);
    let scores: Vec<_> = sets.iter().map(|set| measure(&all, set, args.rounds)).collect();
    line(&format!(
        "\n**{name}**, {} triangles ({:.2} references and {:.0} bytes each); rays: {}\n",
        mesh.triangles.len(),
        stats.references_per_primitive,
        stats.bytes as f64 / mesh.triangles.len() as f64,
        sets.iter().map(|s| format!("{} {}", s.rays.len(), s.kind)).collect::<Vec<_>>().join(", "),
    ));
    line("| | build s | primary | diffuse | shadow | ours / it |\n|---|---|---|---|---|---|");
    for (i, who) in all.iter().enumerate() {
        let rates: Vec<String> = scores.iter().map(|s| format!("{:.2}", s[i].rate)).collect();
        let over: Vec<f64> = scores.iter().map(|s| s[0].rate / s[i].rate).collect();
        for (set, over) in sets.iter().zip(&over) {
            ratios.entry((set.kind, who.name().to_owned())).or_default().push(*over);
        }
        let over: Vec<String> = over.iter().map(|x| format!("{x:.2}")).collect();
        let hits: Vec<String> = scores
            .iter()
            .filter(|s| s[i].hits != s[0].hits)
            .map(|s| format!("{:+}", s[i].hits as i64 - s[0].hits as i64))
            .collect();
        let hits = if hits.is_empty() { String::new() } else { format!(" (hits {})", hits.join(" ")) };
        line(&format!(
            "| {} | {:.3} | {} | {}{hits} |",
            who.name(),
            who.build_seconds(),
            rates.join(" | "),
            over.join(" ")
        ));
    }
    for (set, scores) in sets.iter().zip(&scores) {
        let best = |start: &str| {
            let rates =
                all.iter().zip(scores).filter(|(who, _)| who.name().starts_with(start)).map(|(_, s)| s.rate);
            rates.reduce(f64::max)
        };
        let exact =
            |name: &str| all.iter().zip(scores).find(|(who, _)| who.name() == name).map(|(_, s)| s.rate);
        rows.push(json!({
            "mesh": name,
            "rays": set.kind,
            "ours": scores[0].rate,
            "obvhs_cwbvh": best("obvhs CWBVH"),
            "obvhs_bvh2": best("obvhs BVH2"),
            "embree_high": exact("Embree high"),
            "embree_high_robust": exact("Embree high, robust"),
        }));
    }
    Ok(())
}

/// Geometric means over the meshes.
fn means(ratios: &BTreeMap<(&'static str, String), Vec<f64>>) {
    line("\n| ours / it, geometric mean (lowest) | primary | diffuse | shadow |\n|---|---|---|---|");
    let names: std::collections::BTreeSet<&String> = ratios.keys().map(|(_, name)| name).collect();
    for name in names {
        let cell = |kind: &'static str| {
            let values = ratios.get(&(kind, name.clone())).map_or(&[][..], Vec::as_slice);
            let mean = (values.iter().map(|x| x.ln()).sum::<f64>() / values.len() as f64).exp();
            format!("{mean:.2} ({:.2})", values.iter().copied().fold(f64::INFINITY, f64::min))
        };
        line(&format!("| {name} | {} | {} | {} |", cell("primary"), cell("diffuse"), cell("shadow")));
    }
}

/// Seconds and bytes of builds of generated meshes.
fn growth(args: &Args, embree: Option<&Rc<Embree>>) -> Result<(), String> {
    if args.growth.is_empty() {
        return Ok(());
    }
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().map_err(|e| e.to_string())?;
    line(
        "\n| triangles | build | seconds | on one thread | bytes a triangle | references a triangle |\n|---|---|---|---|---|---|",
    );
    for &n in &args.growth {
        let mesh = meshes::dented_sphere(n);
        let count = mesh.triangles.len();
        for preset in &args.presets {
            let build = || Ours::build(&mesh, preset, None).map(|ours| ours.tree.stats());
            let stats = (0..args.rounds).map(|_| build()).collect::<Result<Vec<_>, _>>()?;
            let alone = (0..args.rounds).map(|_| one.install(build)).collect::<Result<Vec<_>, _>>()?;
            let seconds = |all: &[heliostat_index::TreeStats]| {
                crate::measure::median(all.iter().map(|s| s.build_seconds).collect())
            };
            line(&format!(
                "| {count} | heliostat {preset} | {:.3} | {:.3} | {:.0} | {:.2} |",
                seconds(&stats),
                seconds(&alone),
                stats[0].bytes as f64 / count as f64,
                stats[0].references_per_primitive
            ));
        }
        for (name, seconds) in others(args, embree, &mesh)? {
            line(&format!("| {count} | {name} | {seconds:.3} | | | |"));
        }
    }
    Ok(())
}

/// Median build seconds of the others.
fn others(args: &Args, embree: Option<&Rc<Embree>>, mesh: &TriMesh) -> Result<Vec<(String, f64)>, String> {
    let mut rows = Vec::new();
    for (eight, preset) in [(false, "fast"), (true, "fast"), (true, "very_slow")] {
        let built: Vec<_> = (0..args.rounds).map(|_| Obvhs::build(mesh, eight, preset)).collect();
        let seconds = crate::measure::median(built.iter().map(|b| b.build_seconds()).collect());
        rows.push((built[0].name().to_owned(), seconds));
    }
    if let Some(embree) = embree {
        let built: Vec<_> =
            (0..args.rounds).map(|_| EmbreeScene::build(embree, mesh, false)).collect::<Result<_, _>>()?;
        let seconds = crate::measure::median(built.iter().map(|b| b.build_seconds()).collect());
        rows.push((built[0].name().to_owned(), seconds));
    }
    Ok(rows)
}
