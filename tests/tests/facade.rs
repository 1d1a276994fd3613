//! The facade is easy to read: it has few names at its root, each name is in one room, and each
//! public type's name occurs once. A room is the root of a crate or one of its public modules.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;
use syn::{Attribute, Item, ItemMod, Meta, UseTree, Visibility};

/// The most names at the root: functions, types, traits, constants and modules.
const ROOT_MAX: usize = 40;

fn parsed(file: &Path) -> Vec<Item> {
    let text = fs::read_to_string(file).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
    syn::parse_file(&text).unwrap_or_else(|error| panic!("{}: {error}", file.display())).items
}

const fn is_public(visibility: &Visibility) -> bool {
    matches!(visibility, Visibility::Public(_))
}

fn is_test(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| match &attribute.meta {
        Meta::List(list) => list.path.is_ident("cfg") && list.tokens.to_string() == "test",
        Meta::Path(_) | Meta::NameValue(_) => false,
    })
}

/// The items of a module, and the folder with the files of its modules.
fn inside(module: &ItemMod, folder: &Path) -> (Vec<Item>, PathBuf) {
    let own = folder.join(module.ident.to_string());
    match &module.content {
        Some((_, items)) => (items.clone(), own),
        None => {
            let flat = own.with_extension("rs");
            (parsed(&if flat.is_file() { flat } else { own.join("mod.rs") }), own)
        }
    }
}

/// The names that a `use` brings in.
fn used(tree: &UseTree, names: &mut Vec<String>) {
    match tree {
        UseTree::Path(path) => used(&path.tree, names),
        UseTree::Name(name) => names.push(name.ident.to_string()),
        UseTree::Rename(rename) => names.push(rename.rename.to_string()),
        UseTree::Group(group) => group.items.iter().for_each(|tree| used(tree, names)),
        UseTree::Glob(_) => panic!("a room names what it holds"),
    }
}

/// The public names of a room without its modules, and its public modules.
fn room(items: &[Item]) -> (Vec<String>, Vec<&ItemMod>) {
    let (mut names, mut rooms) = (Vec::new(), Vec::new());
    for item in items {
        let (visibility, name) = match item {
            Item::Mod(module) if is_public(&module.vis) => {
                rooms.push(module);
                continue;
            }
            Item::Use(tree) if is_public(&tree.vis) => {
                used(&tree.tree, &mut names);
                continue;
            }
            Item::Const(item) => (&item.vis, &item.ident),
            Item::Enum(item) => (&item.vis, &item.ident),
            Item::Fn(item) => (&item.vis, &item.sig.ident),
            Item::Static(item) => (&item.vis, &item.ident),
            Item::Struct(item) => (&item.vis, &item.ident),
            Item::Trait(item) => (&item.vis, &item.ident),
            Item::Type(item) => (&item.vis, &item.ident),
            Item::Union(item) => (&item.vis, &item.ident),
            Item::Macro(_) => panic!("a macro may define any name"),
            _ => continue,
        };
        if is_public(visibility) {
            names.push(name.to_string());
        }
    }
    (names, rooms)
}

/// The rooms of each name. The root is the room without a name.
fn rooms_of(source: &Path, is_room: impl Fn(&str) -> bool) -> BTreeMap<String, Vec<String>> {
    let items = parsed(&source.join("lib.rs"));
    let (root, modules) = room(&items);
    let mut found = BTreeMap::<String, Vec<String>>::new();
    let mut add = |names: Vec<String>, room: &str| {
        names.into_iter().for_each(|name| found.entry(name).or_default().push(room.into()));
    };
    add(root, "");
    for module in modules {
        let name = module.ident.to_string();
        if is_room(&name) {
            add(room(&inside(module, source).0).0, &name);
        }
    }
    found
}

fn crates() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates")
}

#[test]
fn the_root_of_the_facade_has_few_names() {
    let items = parsed(&crates().join("texere/src/lib.rs"));
    let (names, rooms) = room(&items);
    let count = names.len() + rooms.len();
    let modules: Vec<_> = rooms.iter().map(|module| module.ident.to_string()).collect();
    assert!(count > 10, "{count} names at the root: they are not found");
    assert!(
        count <= ROOT_MAX,
        "{count} names at the root, {ROOT_MAX} at most: {names:?}, modules {modules:?}"
    );
}

#[test]
fn each_name_lies_in_one_room() {
    // The modules `settling` and `crossings` use the same words for two stages: both have a
    // `settle`, a margin, a bend.
    let core = |room: &str| !matches!(room, "settling" | "crossings");
    let facade = rooms_of(&crates().join("texere/src"), |_| true);
    for (room, found) in
        [("texere", facade), ("texere-core", rooms_of(&crates().join("texere-core/src"), core))]
    {
        assert!(found.values().flatten().collect::<BTreeSet<_>>().len() >= 3, "{room}: rooms are not found");
        // Reading and writing a thing have the same name: `read::yarns`, `write::yarns`.
        let twice: Vec<_> =
            found.iter().filter(|(_, rooms)| rooms.len() > 1 && **rooms != ["read", "write"]).collect();
        assert!(twice.is_empty(), "{room}: names in two rooms: {twice:?}");
    }
}

/// Public types of a module and of the modules in it.
fn types(items: &[Item], folder: &Path, at: &str, found: &mut BTreeMap<String, BTreeSet<String>>) {
    for item in items {
        let (visibility, name) = match item {
            Item::Mod(module) if !is_test(&module.attrs) => {
                let (items, folder) = inside(module, folder);
                types(&items, &folder, &format!("{at}::{}", module.ident), found);
                continue;
            }
            Item::Enum(item) => (&item.vis, &item.ident),
            Item::Struct(item) => (&item.vis, &item.ident),
            Item::Trait(item) => (&item.vis, &item.ident),
            Item::TraitAlias(item) => (&item.vis, &item.ident),
            Item::Type(item) => (&item.vis, &item.ident),
            Item::Union(item) => (&item.vis, &item.ident),
            _ => continue,
        };
        if is_public(visibility) {
            found.entry(name.to_string()).or_default().insert(format!("{at}::{name}"));
        }
    }
}

/// Names and root files of the workspace's published libraries.
fn published() -> Vec<(String, PathBuf)> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let output = Command::new(cargo)
        .args(["metadata", "--format-version", "1", "--locked", "--no-deps"])
        .current_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join(".."))
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let metadata: Value = serde_json::from_slice(&output.stdout).unwrap();
    let list = |value: &Value| value.as_array().unwrap().clone();
    let is_library = |target: &Value| list(&target["kind"]).iter().any(|kind| kind == "lib");
    list(&metadata["packages"])
        .iter()
        .filter(|package| package["publish"].is_null())
        .flat_map(|package| list(&package["targets"]))
        .filter(is_library)
        .map(|target| (target["name"].as_str().unwrap().into(), target["src_path"].as_str().unwrap().into()))
        .collect()
}

#[test]
fn each_public_type_has_a_name_of_its_own() {
    let mut found = BTreeMap::new();
    let libraries = published();
    for (name, root) in &libraries {
        types(&parsed(root), root.parent().unwrap(), name, &mut found);
    }
    assert!(libraries.len() > 8 && found.len() > 100, "{} libraries, {} types", libraries.len(), found.len());
    let twice: Vec<_> = found.values().filter(|places| places.len() > 1).collect();
    assert!(twice.is_empty(), "types of one name: {twice:#?}");
}
