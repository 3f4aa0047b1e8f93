//! Structs that host and shaders share, declared once in Rust and generated into GLSL.
//!
//! Both sides use the same bytes: `#[repr(C)]` without padding here, `layout(scalar)` there.

use std::fmt::Write as _;

/// Words of a texel.
const TEXEL_WORDS: usize = 4;

/// A struct declared with [`crate::gpu_struct`], as data.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StructInfo {
    /// Name of the struct in Rust and in GLSL.
    pub name: &'static str,
    /// The declaration of every member in GLSL, without padding.
    pub members: &'static [&'static str],
    /// (name, byte offset) of every field, in order, without padding.
    pub fields: &'static [(&'static str, usize)],
    /// Words behind the last field, which fill the last texel.
    pub padding: usize,
    /// Size in bytes, which is the stride in arrays too.
    pub size: usize,
}

impl StructInfo {
    /// Declaration of the struct in GLSL.
    pub fn glsl(&self) -> String {
        let members = self.members.iter().map(|member| format!("    {member};\n"));
        let padding = (self.padding > 0).then(|| format!("    uint padding[{}];\n", self.padding));
        format!("struct {} {{\n{}}};\n", self.name, members.chain(padding).collect::<String>())
    }

    /// Whether all members are floats, so that the struct is read as texels of floats; else of unsigned integers, whose
    /// bits no device changes.
    pub const fn is_float(&self) -> bool {
        let mut member = 0;
        while member < self.members.len() {
            if !matches!(self.members[member].as_bytes(), [b'f' | b'v' | b'm', ..]) {
                return false;
            }
            member += 1;
        }
        true
    }

    /// A GLSL function `name` that reads the struct at an index of an array that `view` shows as texels of four words.
    ///
    /// # Panics
    /// For a member that is an array or a struct, or where the struct does not fill its texels: faults of the program.
    pub fn reader(&self, name: &str, view: &str) -> String {
        let texels = self.size / (4 * TEXEL_WORDS);
        assert_eq!(self.size % (4 * TEXEL_WORDS), 0, "{} does not fill its texels", self.name);
        let texel = if self.is_float() { "vec4" } else { "uvec4" };
        let mut text =
            format!("{} {name}(uint index)\n{{\n    int first = int({texels}u * index);\n", self.name);
        for number in 0..texels {
            let _ = writeln!(text, "    {texel} texel{number} = texelFetch({view}, first + {number});");
        }
        let _ = writeln!(text, "    {} item;", self.name);
        for (member, &(field, offset)) in self.members.iter().zip(self.fields) {
            let kind = member.split(' ').next().expect("a member has a type");
            let _ = writeln!(text, "    item.{field} = {};", unpacked(kind, offset / 4, self.is_float()));
        }
        text + "    return item;\n}\n"
    }
}

/// A member of type `kind`, in GLSL, from its first word on in what `StructInfo::reader` has fetched.
fn unpacked(kind: &str, first: usize, float_texels: bool) -> String {
    if kind == "mat4" {
        let columns = [0, 4, 8, 12].map(|word| unpacked("vec4", first + word, float_texels));
        return format!("mat4({})", columns.join(", "));
    }
    let (scalar, count) = match kind {
        "float" | "vec2" | "vec3" | "vec4" => ("float", width(kind)),
        "uint" | "uvec2" | "uvec3" | "uvec4" => ("uint", width(kind)),
        "int" | "ivec2" | "ivec3" | "ivec4" => ("int", width(kind)),
        other => unreachable!("no {other} is read from texels"),
    };
    let words = words(first, count, if float_texels { "vec" } else { "uvec" });
    match (scalar, float_texels) {
        ("float", false) => format!("uintBitsToFloat({words})"),
        ("int", _) => format!("{kind}({words})"),
        _ => words,
    }
}

/// How many words a scalar or a vector is.
fn width(kind: &str) -> usize {
    kind.chars().last().and_then(|last| last.to_digit(10)).unwrap_or(1) as usize
}

/// Words of consecutive texels; `vector` makes one of them where they lie in two.
fn words(first: usize, count: usize, vector: &str) -> String {
    let in_texel = |from: usize, to: usize| {
        let place = from % TEXEL_WORDS;
        format!("texel{}.{}", from / TEXEL_WORDS, &"xyzw"[place..place + to - from])
    };
    let end = first + count;
    let boundary = (first + 1).next_multiple_of(TEXEL_WORDS);
    if end <= boundary {
        in_texel(first, end)
    } else {
        format!("{vector}{count}({}, {})", in_texel(first, boundary), in_texel(boundary, end))
    }
}

/// Words that bring `bytes` to whole texels, where some `units` are asked for.
pub const fn padding_words(bytes: usize, units: &[&str]) -> usize {
    let texel = 4 * TEXEL_WORDS;
    if units.is_empty() { 0 } else { (bytes.next_multiple_of(texel) - bytes) / 4 }
}

/// The text of an include that declares `structs`; a struct comes after those it contains.
pub fn declarations(structs: &[StructInfo]) -> String {
    let body: Vec<_> = structs.iter().map(StructInfo::glsl).collect();
    format!("#pragma once\n\n{}", body.join("\n"))
}

/// Declares structs for host and shaders.
///
/// Each becomes a plain-old-data Rust struct (`Default` is all zeros) with the constant `INFO` (a [`StructInfo`]). A
/// struct `in texels` is read as texels of four words, which `padding` fills up behind its fields. Fields may be
///
/// | Rust | GLSL |
/// | --- | --- |
/// | `f32`, `u32`, `i32` | `float`, `uint`, `int` |
/// | `[f32; 2]` to `[f32; 4]`, `u32` and `i32` alike | `vec2` to `vec4`, `uvec*`, `ivec*` |
/// | `[[f32; 4]; 4]` | `mat4`, four columns |
/// | `[[f32; 4]; 3]` | `mat3x4`, three columns (the rows of an affine transform) |
/// | another struct | the same |
/// | `[T; n]` of any other kind, `n` a literal | `T name[n]` |
#[macro_export]
macro_rules! gpu_struct {
    ($(
        $(#[$meta:meta])*
        $vis:vis struct $name:ident $(in $unit:ident)? {
            $($(#[$field_meta:meta])* $field_vis:vis $field:ident : $type:tt),+ $(,)?
        }
    )+) => { $(
        $(#[$meta])*
        #[repr(C)]
        #[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
        $vis struct $name {
            $($(#[$field_meta])* $field_vis $field : $type),+
            $(, #[doc = concat!("Fills the last of the ", stringify!($unit), ".")] pub padding: [u32; $name::PADDING])?
        }

        impl $name {
            /// Words behind the fields.
            const PADDING: usize =
                $crate::gpu_types::padding_words(0 $(+ size_of::<$type>())+, &[$(stringify!($unit))?]);
            /// What generators need to know of the struct.
            pub const INFO: $crate::gpu_types::StructInfo = $crate::gpu_types::StructInfo {
                name: stringify!($name),
                members: &[$($crate::glsl_member!(stringify!($field), $type)),+],
                fields: &[$((stringify!($field), std::mem::offset_of!($name, $field))),+],
                padding: Self::PADDING,
                size: size_of::<Self>(),
            };
        }

        impl Default for $name {
            fn default() -> Self {
                bytemuck::Zeroable::zeroed()
            }
        }
    )+ };
}

/// The GLSL declaration of one member from its declarator (a name, perhaps with array sizes) and Rust type.
#[doc(hidden)]
#[macro_export]
macro_rules! glsl_member {
    ($name:expr, f32) => {
        concat!("float ", $name)
    };
    ($name:expr, u32) => {
        concat!("uint ", $name)
    };
    ($name:expr, i32) => {
        concat!("int ", $name)
    };
    ($name:expr, [f32; 2]) => {
        concat!("vec2 ", $name)
    };
    ($name:expr, [f32; 3]) => {
        concat!("vec3 ", $name)
    };
    ($name:expr, [f32; 4]) => {
        concat!("vec4 ", $name)
    };
    ($name:expr, [u32; 2]) => {
        concat!("uvec2 ", $name)
    };
    ($name:expr, [u32; 3]) => {
        concat!("uvec3 ", $name)
    };
    ($name:expr, [u32; 4]) => {
        concat!("uvec4 ", $name)
    };
    ($name:expr, [i32; 2]) => {
        concat!("ivec2 ", $name)
    };
    ($name:expr, [i32; 3]) => {
        concat!("ivec3 ", $name)
    };
    ($name:expr, [i32; 4]) => {
        concat!("ivec4 ", $name)
    };
    ($name:expr, [[f32; 4]; 4]) => {
        concat!("mat4 ", $name)
    };
    ($name:expr, [[f32; 4]; 3]) => {
        concat!("mat3x4 ", $name)
    };
    ($name:expr, [$element:tt; $count:literal]) => {
        $crate::glsl_member!(concat!($name, "[", $count, "]"), $element)
    };
    ($name:expr, $nested:ident) => {
        concat!(stringify!($nested), " ", $name)
    };
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::vk::ShaderLibrary;
    use spirq::prelude::*;

    gpu_struct! {
        /// The inner one.
        pub struct Inner {
            /// Three floats, so that what follows is not aligned to 16 bytes.
            pub point: [f32; 3],
            pub count: u32,
            pub cell: [i32; 3],
        }

        /// One of everything.
        pub struct Outer {
            pub flag: u32,
            pub place: [f32; 2],
            pub inner: Inner,
            pub clip: [[f32; 4]; 4],
            pub rows: [[f32; 4]; 3],
            pub lone: f32,
            pub dims: [u32; 3],
            pub planes: [[f32; 4]; 6],
            pub many: [Inner; 2],
            pub table: [[u32; 5]; 2],
            pub views: [[[f32; 4]; 4]; 2],
            pub last: i32,
        }
    }

    /// Compiles a shader that holds arrays of `structs` and compares the offsets and strides in its SPIR-V with the
    /// host's.
    pub(crate) fn assert_layouts(structs: &[StructInfo]) {
        let buffer = |(binding, info): (usize, &StructInfo)| {
            let name = info.name;
            format!(
                "layout(scalar, binding = {binding}) buffer Buffer{binding} {{ {name} items[]; }} b{binding};\n"
            )
        };
        let buffers: String = structs.iter().enumerate().map(buffer).collect();
        let source = format!(
            "#version 460\n#extension GL_EXT_scalar_block_layout : require\n#include \"generated/probe.glsl\"\n\
             {buffers}void main() {{}}\n"
        );
        let generated =
            vec![("probe.comp".into(), source), ("generated/probe.glsl".into(), declarations(structs))];
        let library = ShaderLibrary::new(None, generated).unwrap().with_cache(None);
        let words = library.compile("probe.comp", &[]).unwrap();
        let entries = ReflectConfig::new().spv(words.as_slice()).ref_all_rscs(true).reflect().unwrap();
        assert_eq!(entries[0].vars.len(), structs.len());
        for var in &entries[0].vars {
            let Variable::Descriptor { desc_bind, ty: Type::Struct(block), .. } = var else {
                panic!("{var:?} is no buffer");
            };
            let info = structs[desc_bind.bind() as usize];
            let Type::Array(items) = &block.members[0].ty else { panic!("{} is no array", info.name) };
            let Type::Struct(item) = &*items.element_ty else { panic!("{} is no struct", info.name) };
            let member = |m: &spirq::ty::StructMember| (m.name.clone().unwrap(), m.offset.unwrap());
            let device: Vec<_> = item.members.iter().map(member).collect();
            let mut host: Vec<_> =
                info.fields.iter().map(|&(name, offset)| (name.to_owned(), offset)).collect();
            if info.padding > 0 {
                host.push(("padding".to_owned(), info.size - 4 * info.padding));
            }
            assert_eq!(device, host, "{}", info.name);
            assert_eq!(items.stride, Some(info.size), "{}", info.name);
        }
    }

    #[test]
    fn shaders_see_the_offsets_of_the_host() {
        assert_layouts(&[Inner::INFO, Outer::INFO]);
    }

    #[test]
    #[should_panic(expected = "Inner")]
    fn a_wrong_offset_is_noticed() {
        let fields = &[("point", 0), ("count", 16), ("cell", 20)];
        assert_layouts(&[StructInfo { fields, ..Inner::INFO }]);
    }

    #[test]
    fn every_type_has_its_glsl() {
        let expected = "struct Outer {\n    uint flag;\n    vec2 place;\n    Inner inner;\n    mat4 clip;\n    \
                        mat3x4 rows;\n    float lone;\n    uvec3 dims;\n    vec4 planes[6];\n    Inner many[2];\n    \
                        uint table[2][5];\n    mat4 views[2];\n    int last;\n};\n";
        assert_eq!(Outer::INFO.glsl(), expected);
    }

    gpu_struct! {
        /// Floats alone, over the end of a texel.
        pub struct Floats in texels {
            pub place: [f32; 3],
            pub colour: [f32; 3],
            pub transform: [[f32; 4]; 4],
        }

        /// Both kinds.
        pub struct Mixed in texels {
            pub kind: u32,
            pub cell: [i32; 2],
            pub direction: [f32; 3],
        }
    }

    #[test]
    fn structs_fill_their_texels() {
        assert_eq!([size_of::<Floats>(), size_of::<Mixed>()], [96, 32]);
        assert_layouts(&[Floats::INFO, Mixed::INFO]);
    }

    #[test]
    fn what_is_read_from_texels_is_what_the_host_wrote() {
        let floats = Floats::INFO.reader("read_floats", "float_texels");
        assert_eq!(floats.matches("texelFetch").count(), 6);
        assert!(floats.contains("item.colour = vec3(texel0.w, texel1.xy);"), "{floats}");
        assert!(floats.contains("vec4(texel1.zw, texel2.xy)"), "{floats}");
        let mixed = Mixed::INFO.reader("read_mixed", "mixed_texels");
        assert!(mixed.contains("item.kind = texel0.x;"), "{mixed}");
        assert!(mixed.contains("item.cell = ivec2(texel0.yz);"), "{mixed}");
        assert!(mixed.contains("item.direction = uintBitsToFloat(uvec3(texel0.w, texel1.xy));"), "{mixed}");
    }
}
