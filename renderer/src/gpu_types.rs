//! Structs that host and shaders share, declared once in Rust and generated into GLSL.
//!
//! Both sides use the same bytes: `#[repr(C)]` without padding here, `layout(scalar)` there.

/// A struct declared with [`crate::gpu_struct`], as data.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StructInfo {
    /// Name on both sides.
    pub name: &'static str,
    /// Its declaration in GLSL.
    pub glsl: &'static str,
    /// (name, byte offset) of every field, in order.
    pub fields: &'static [(&'static str, usize)],
    /// Bytes, and the stride in arrays.
    pub size: usize,
}

/// The text of an include that declares `structs`; a struct comes after those it contains.
pub fn declarations(structs: &[StructInfo]) -> String {
    let body: Vec<_> = structs.iter().map(|info| info.glsl).collect();
    format!("#pragma once\n\n{}", body.join("\n"))
}

/// Declares structs for host and shaders.
///
/// Each becomes a plain-old-data Rust struct (`Default` is all zeros) with the constants `GLSL` (its declaration),
/// `FIELDS` (name and byte offset of every field) and `INFO` (a [`StructInfo`]). Fields may be
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
        $vis:vis struct $name:ident {
            $($(#[$field_meta:meta])* $field_vis:vis $field:ident : $type:tt),+ $(,)?
        }
    )+) => { $(
        $(#[$meta])*
        #[repr(C)]
        #[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
        $vis struct $name { $($(#[$field_meta])* $field_vis $field : $type),+ }

        impl $name {
            /// The declaration in GLSL.
            pub const GLSL: &'static str = concat!(
                "struct ", stringify!($name), " {\n",
                $("    ", $crate::glsl_member!(stringify!($field), $type), ";\n",)+
                "};\n"
            );
            /// Name and byte offset of every field, in order.
            pub const FIELDS: &'static [(&'static str, usize)] =
                &[$((stringify!($field), std::mem::offset_of!($name, $field))),+];
            /// All of it as data.
            pub const INFO: $crate::gpu_types::StructInfo = $crate::gpu_types::StructInfo {
                name: stringify!($name),
                glsl: Self::GLSL,
                fields: Self::FIELDS,
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
            let host: Vec<_> = info.fields.iter().map(|&(name, offset)| (name.to_owned(), offset)).collect();
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
        assert_eq!(Outer::GLSL, expected);
    }
}
