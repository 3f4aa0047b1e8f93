//! One run of glslang, with its includes and its errors.

use super::sources::{Closure, Include, Sources, blank_lines, directive};
use crate::{Error, Result};
use glslang::error::GlslangError;
use glslang::include::{IncludeHandler, IncludeResult, IncludeType};
use glslang::{
    Compiler, CompilerOptions, ShaderInput, ShaderMessage, ShaderSource, ShaderStage, SourceLanguage,
    SpirvVersion, Target, VulkanVersion,
};
use std::collections::{BTreeMap, BTreeSet};

/// Part of every cache key: the compiler and how it is called here. A test holds it against Cargo.lock.
pub(super) const COMPILER_VERSION: &str = "glslang 0.9.1, glslang-sys 0.9.2+e1b562a, Vulkan 1.3, SPIR-V 1.6";

/// Deeper includes are taken for a cycle.
const MAX_INCLUDE_DEPTH: usize = 64;

/// The stage that the extension of `path` names.
pub(super) fn stage(path: &str) -> Result<ShaderStage> {
    match path.rsplit_once('.').map(|(_, extension)| extension) {
        Some("vert") => Ok(ShaderStage::Vertex),
        Some("frag") => Ok(ShaderStage::Fragment),
        Some("comp") => Ok(ShaderStage::Compute),
        _ => Err(Error::Internal(format!("shader {path}: its name must end in .vert, .frag or .comp"))),
    }
}

/// Compiles the root of `closure` with `defines`.
///
/// # Errors
/// glslang's first error (it stops there; what else it says is the consequence) in one line with file, line and
/// include stack.
pub(super) fn compile(
    sources: &Sources,
    closure: &Closure,
    defines: &BTreeMap<&str, &str>,
) -> Result<Vec<u32>> {
    let stage = stage(&closure.root)?;
    let source = ShaderSource::from(root_text(sources, closure, defines)?);
    let options = CompilerOptions {
        source_language: SourceLanguage::GLSL,
        target: Target::Vulkan { version: VulkanVersion::Vulkan1_3, spirv_version: SpirvVersion::SPIRV1_6 },
        version_profile: None,
        messages: ShaderMessage::SPV_RULES | ShaderMessage::VULKAN_RULES,
    };
    let mut includer = Includer { closure, stacks: BTreeMap::new(), too_deep: None };
    let outcome = run(&source, stage, &options, &mut includer);
    if let Some((header, includer_name)) = &includer.too_deep {
        let line = closure.include(header, includer_name).map_or(1, |include| include.line);
        let message =
            format!("#include \"{header}\" never ends: the file includes itself, add #pragma once to it");
        return Err(sources.error(includer_name, line, &message));
    }
    outcome.map_err(|error| report(sources, &includer, defines, &error))
}

fn run(
    source: &ShaderSource,
    stage: ShaderStage,
    options: &CompilerOptions,
    includer: &mut Includer<'_>,
) -> Result<Vec<u32>, GlslangError> {
    let compiler = Compiler::acquire().expect("glslang starts unless memory is out");
    let no_defines: Option<&[(&str, Option<&str>)]> = None;
    let input = ShaderInput::new(source, stage, options, no_defines, Some(includer))?;
    let shader = compiler.create_shader(input)?;
    let warnings = shader.get_log();
    warnings.lines().filter(|line| !line.trim().is_empty()).for_each(|line| tracing::warn!("{line}"));
    shader.compile()
}

/// The text of the root behind its version line, the line directives and the defines, sorted by name.
fn root_text(sources: &Sources, closure: &Closure, defines: &BTreeMap<&str, &str>) -> Result<String> {
    let root = &closure.root;
    let is_version = |line: &str| directive(line, "version").is_some();
    let text = closure.files[root].without_pragma_once();
    let version = text.lines().find(|line| is_version(line)).ok_or_else(|| {
        sources.error(root, 1, "a shader must name its language version first: #version 460")
    })?;
    let mut head = format!("{}\n", version.trim());
    for extension in ["GL_GOOGLE_include_directive", "GL_GOOGLE_cpp_style_line_directive"] {
        head += &format!("#extension {extension} : require\n");
    }
    for (name, value) in defines {
        if name.is_empty() || format!("{name}{value}").contains(['\n', '\0']) {
            return Err(Error::Internal(format!(
                "shader {root}: the define {name:?} = {value:?} is malformed"
            )));
        }
        head += &format!("#define {name} {value}\n");
    }
    Ok(format!("{head}#line 1 \"{root}\"\n{}", blank_lines(&text, is_version)))
}

/// Answers glslang's includes from the closure, and remembers who asked.
struct Includer<'a> {
    closure: &'a Closure,
    /// For every included file the file and line of its first include.
    stacks: BTreeMap<&'a str, (&'a str, u32)>,
    /// (header, includer) of the include that went too deep.
    too_deep: Option<(String, String)>,
}

impl<'a> Includer<'a> {
    fn find(&self, header: &str, includer: &str) -> Option<(&'a str, &'a Include)> {
        let (name, file) = self.closure.files.get_key_value(includer)?;
        let include = file.includes.iter().find(|include| include.header == header)?;
        Some((name, include))
    }

    /// `, included from A:1, from B:2` up to the root; empty for the root.
    fn stack_text(&self, file: &str) -> String {
        let mut text = String::new();
        let mut seen = BTreeSet::from([file]);
        let mut next = self.stacks.get(file);
        while let Some(&(parent, line)) = next {
            text += if text.is_empty() { ", included from " } else { ", from " };
            text += &format!("{parent}:{line}");
            next = self.stacks.get(parent).filter(|_| seen.insert(parent));
        }
        text
    }
}

impl IncludeHandler for Includer<'_> {
    fn include(
        &mut self,
        _: IncludeType,
        header: &str,
        includer: &str,
        depth: usize,
    ) -> Option<IncludeResult> {
        let includer = if includer.is_empty() { self.closure.root.as_str() } else { includer };
        if depth > MAX_INCLUDE_DEPTH {
            self.too_deep.get_or_insert_with(|| (header.to_owned(), includer.to_owned()));
            return None;
        }
        let (parent, include) = self.find(header, includer)?;
        let (name, file) = self.closure.files.get_key_value(&include.target)?;
        let again = self.stacks.contains_key(name.as_str()) || *name == self.closure.root;
        self.stacks.entry(name).or_insert((parent, include.line));
        let data = if again && file.once() {
            String::new()
        } else {
            include_text(name, &file.without_pragma_once())
        };
        Some(IncludeResult { name: name.clone(), data })
    }
}

/// An included file's text, named for error messages.
fn include_text(name: &str, text: &str) -> String {
    format!("#line 1 \"{name}\"\n{text}")
}

/// One error of glslang's log.
#[derive(Debug, PartialEq)]
struct Diagnostic<'a> {
    file: &'a str,
    line: u32,
    message: &'a str,
}

/// `ERROR: FILE:LINE: MESSAGE`
fn diagnostic(line: &str) -> Option<Diagnostic<'_>> {
    let text = line.strip_prefix("ERROR: ")?;
    let mut colons = text.match_indices(':').map(|(at, _)| at);
    let mut start = colons.next()?;
    for end in colons {
        if let Ok(line) = text[start + 1..end].parse() {
            return Some(Diagnostic { file: &text[..start], line, message: text[end + 1..].trim() });
        }
        start = end;
    }
    None
}

fn report(
    sources: &Sources,
    includer: &Includer<'_>,
    defines: &BTreeMap<&str, &str>,
    error: &GlslangError,
) -> Error {
    let root = includer.closure.root.as_str();
    let log = match error {
        GlslangError::ParseError(log) | GlslangError::PreprocessError(log) | GlslangError::LinkError(log) => {
            &log.log
        }
        other => return sources.error(root, 1, &other.to_string()),
    };
    tracing::debug!("{}", log.trim_end());
    let Some(first) = log.lines().find_map(diagnostic) else {
        return sources.error(root, 1, &log.split_whitespace().collect::<Vec<_>>().join(" "));
    };
    let file = if includer.closure.files.contains_key(first.file) { first.file } else { root };
    let given: Vec<_> = defines.iter().map(|(name, value)| format!("{name}={value}")).collect();
    let with = if given.is_empty() { String::new() } else { format!(" [with {}]", given.join(" ")) };
    let stack = includer.stack_text(file);
    sources.error(file, first.line, &format!("{}{stack}{with}", first.message))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_diagnostic_is_split_at_its_line_number() {
        let parsed = diagnostic("ERROR: lib/a.glsl:12: 'x' : undeclared identifier");
        let (file, message) = ("lib/a.glsl", "'x' : undeclared identifier");
        assert_eq!(parsed, Some(Diagnostic { file, line: 12, message }));
        assert_eq!(diagnostic("ERROR: 1 compilation errors.  No code generated."), None);
    }

    #[test]
    fn the_compiler_version_in_cache_keys_is_the_locked_one() {
        let lock = include_str!("../../../../Cargo.lock");
        let version = |name: &str| {
            let (_, rest) = lock.split_once(&format!("name = \"{name}\"\nversion = \"")).unwrap();
            format!("{name} {}", rest.split('"').next().unwrap())
        };
        assert!(COMPILER_VERSION.contains(&version("glslang")));
        assert!(COMPILER_VERSION.contains(&version("glslang-sys")));
    }
}
