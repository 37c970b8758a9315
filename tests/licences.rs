//! Every dependency comes from the registry under a licence that `deny.toml` allows.

use std::process::Command;

/// The strings of the list `allow` in `deny.toml`.
fn allowed() -> Vec<String> {
    let text = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/deny.toml")).unwrap();
    let list = text.split("allow = [").nth(1).unwrap().split(']').next().unwrap();
    list.split('"').skip(1).step_by(2).map(str::to_owned).collect()
}

/// The packages of this build as Cargo resolves them. Those of other systems need not have been
/// downloaded.
fn packages() -> Vec<serde_json::Value> {
    let cargo = env!("CARGO");
    let version = Command::new(cargo).arg("-vV").output().unwrap();
    let version = String::from_utf8(version.stdout).unwrap();
    let host = version.lines().find_map(|l| l.strip_prefix("host: ")).unwrap();
    let arguments =
        ["metadata", "--locked", "--offline", "--format-version", "1", "--filter-platform", host];
    let run = Command::new(cargo)
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    let metadata: serde_json::Value = serde_json::from_slice(&run.stdout).unwrap();
    metadata["packages"].as_array().unwrap().clone()
}

/// The fault of a package, if any.
fn fault(package: &serde_json::Value, allowed: &[String]) -> Option<String> {
    let name = format!("{} {}", package["name"].as_str()?, package["version"].as_str()?);
    let own = package["source"].is_null();
    if !own && package["source"] != "registry+https://github.com/rust-lang/crates.io-index" {
        return Some(format!("{name} comes from {}", package["source"]));
    }
    let Some(licence) = package["license"].as_str() else {
        return Some(format!("{name} names no licence"));
    };
    // Older packages write a slash for OR.
    let expression = match spdx::Expression::parse_mode(licence, spdx::ParseMode::LAX) {
        Ok(expression) => expression,
        Err(e) => return Some(format!("{name}: {licence} cannot be read: {e}")),
    };
    let may = expression.evaluate(|r| allowed.contains(&r.to_string()));
    (!may).then(|| format!("{name} is under {licence}, which deny.toml does not allow"))
}

#[test]
fn every_dependency_may_be_used() {
    let (allowed, packages) = (allowed(), packages());
    assert!(allowed.len() > 5 && packages.len() > 100, "{allowed:?}, {} packages", packages.len());
    let faults: Vec<String> = packages.iter().filter_map(|p| fault(p, &allowed)).collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn what_may_not_be_used_is_reported() {
    let allowed = ["MIT".to_owned(), "Zlib".to_owned()];
    let package = |licence: serde_json::Value, source: &str| serde_json::json!({"name": "n", "version": "1", "source": source, "license": licence});
    let registry = "registry+https://github.com/rust-lang/crates.io-index";
    for licence in ["MIT", "GPL-3.0-only OR MIT", "GPL-3.0-only/Zlib", "(MIT OR ISC) AND Zlib"] {
        assert_eq!(fault(&package(licence.into(), registry), &allowed), None, "{licence}");
    }
    for licence in ["GPL-3.0-only", "MIT AND GPL-3.0-only", "Zlib WITH LLVM-exception", "free"] {
        assert!(fault(&package(licence.into(), registry), &allowed).is_some(), "{licence}");
    }
    assert!(fault(&package(serde_json::Value::Null, registry), &allowed).is_some());
    assert!(fault(&package("MIT".into(), "git+https://example.org"), &allowed).is_some());
}
