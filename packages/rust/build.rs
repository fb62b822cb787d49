// Compiles src/neuralsvcd.c with the C compiler, and writes the enum ErrorKind of the header's result codes.
//
// CC, CFLAGS and AR are honoured, also as CC_x86_64_unknown_linux_gnu and so on. Without them it is `cc` and `ar`, or
// `cl` and `lib` of a developer's prompt where the target is MSVC. CFLAGS come last.
use std::env;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A variable for this target, or else for all.
fn setting(name: &str) -> Option<String> {
    let own = format!("{}_{}", name, env::var("TARGET").unwrap().replace('-', "_"));
    println!("cargo:rerun-if-env-changed={}", own);
    println!("cargo:rerun-if-env-changed={}", name);
    env::var(own).or_else(|_| env::var(name)).ok()
}

/// A command with its first arguments: CC may be `ccache gcc`.
fn tool(name: &str, default: &str) -> Command {
    let line = setting(name).unwrap_or_else(|| {
        assert_eq!(env::var("HOST"), env::var("TARGET"), "to compile for another machine, set {} and AR", name);
        default.to_string()
    });
    let mut words = line.split_whitespace();
    let mut command = Command::new(words.next().expect("it is empty"));
    command.args(words);
    command
}

fn run(command: &mut Command) {
    match command.status() {
        Ok(status) if status.success() => {}
        Ok(status) => panic!("{:?}: {}", command, status),
        Err(error) => panic!(
            "{:?}: {}. A C compiler is needed. CC says which; `cl` is on the path of a developer's prompt",
            command, error
        ),
    }
}

fn compile(headers: &Path, out: &Path) {
    let target = env::var("TARGET").unwrap();
    let is_msvc = target.ends_with("msvc");
    let (cc, ar) = match &target[..] {
        _ if is_msvc => ("cl", "lib"),
        _ if target.contains("windows") => ("gcc", "ar"),
        _ => ("cc", "ar"),
    };
    let mut compiler = tool("CC", cc);
    let mut archiver = tool("AR", ar);
    let object = out.join("neuralsvcd.o");
    if is_msvc {
        compiler.args(["/nologo", "/O2", "/c"]).arg(format!("/Fo{}", object.display()));
        archiver.arg("/nologo").arg(format!("/OUT:{}", out.join("neuralsvcd.lib").display()));
    } else {
        // Without -O2, queries take 28 times as long: also a debug build has it.
        let level = env::var("OPT_LEVEL").unwrap();
        let level = if level == "0" || level == "1" { "2".to_string() } else { level };
        let level = if level == "z" { "s".to_string() } else { level };
        compiler.arg(format!("-O{}", level));
        compiler.args(["-std=c99", "-ffunction-sections", "-fdata-sections", "-c"]);
        if !target.contains("windows") {
            compiler.arg("-fPIC");
            println!("cargo:rustc-link-lib=m");
        }
        compiler.arg("-o").arg(&object);
        archiver.arg("crs").arg(out.join("libneuralsvcd.a"));
    }
    compiler.arg("-I").arg(headers);
    compiler.args(setting("CFLAGS").unwrap_or_default().split_whitespace());
    run(compiler.arg("src/neuralsvcd.c"));
    run(archiver.arg(&object));
    println!("cargo:rustc-link-search=native={}", out.display());
    println!("cargo:rustc-link-lib=static=neuralsvcd");
}

/// TOO_LARGE -> TooLarge.
fn camel(name: &str) -> String {
    name.split('_').map(|word| word[..1].to_string() + &word[1..].to_lowercase()).collect()
}

/// The enumerators of nsvcd_result, with the header's comments.
fn error_kinds(header: &str) -> String {
    let begin = header.find("typedef enum nsvcd_result {").expect("nsvcd_result");
    let end = begin + header[begin..].find('}').unwrap();
    let mut variants = String::new();
    let mut names = String::new();
    for line in header[begin..end].lines().map(str::trim) {
        if let Some(name) = line.strip_prefix("NSVCD_ERROR_") {
            let name = camel(name.trim_end_matches(','));
            writeln!(variants, "    {},", name).unwrap();
            write!(names, "ErrorKind::{}, ", name).unwrap();
        } else if line.starts_with("// ") && !line.starts_with("// ----") {
            writeln!(variants, "    /{}", line.replace('[', "\\[")).unwrap();
        }
    }
    format!(
        "/// What was refused, as `nsvcd_result` of neuralsvcd.h names it.\n\
         #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]\n#[non_exhaustive]\npub enum ErrorKind {{\n{}}}\n\
         const ERROR_KINDS: &[ErrorKind] = &[{}];\n",
        variants, names
    )
}

fn main() {
    // The crate as it is published has the headers; in the repository they are further up.
    let own = PathBuf::from(env::var("CARGO_MANIFEST_DIR").unwrap());
    let headers = if own.join("neuralsvcd.h").exists() { own } else { own.join("../..") };
    let out = PathBuf::from(env::var("OUT_DIR").unwrap());
    let header = headers.join("neuralsvcd.h");
    for file in [&header, &headers.join("weights.h"), Path::new("src/neuralsvcd.c"), Path::new("build.rs")] {
        println!("cargo:rerun-if-changed={}", file.display());
    }
    let text = std::fs::read_to_string(&header).unwrap_or_else(|error| panic!("{}: {}", header.display(), error));
    std::fs::write(out.join("error_kind.rs"), error_kinds(&text)).unwrap();
    compile(&headers, &out);
}
