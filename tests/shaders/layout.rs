//! The records that host and shaders share: names, types, offsets and sizes, the host's against
//! naga's of the WGSL structs in every program.

#![allow(clippy::unwrap_used, reason = "a helper of tests fails by panicking")]

use std::collections::BTreeMap;
use std::mem::offset_of;

use gpu_vpl::bvh::{WideChild, WideNode};
use gpu_vpl::gpu::{
    AreaLightRecord, ArrivalRecord, BsdfRecord, CameraParams, CompensatedParams, CorrectParams,
    DeltaLightRecord, DirectParams, DirectionalLightRecord, ExpandParams, FilterParams,
    GlossyVplRecord, GuideParams, InterleaveParams, LightStratumRecord, MaterialRecord, NodeRecord,
    PathParams, PathRecord, PathSum, PointLightRecord, PointRecord, ShadeParams, SphereLightRecord,
    SpotLightRecord, StartParams, TextureRecord, TriangleRecord, VisibilityParams, VplRecord,
};
use gpu_vpl::render::all_programs;
use naga::{ScalarKind, TypeInner};

/// A member: name, offset, kind of its scalars, and how many.
type Member = (String, u32, ScalarKind, u32);

/// Host types that members may have.
trait Field {
    /// The members of this name at this offset.
    fn members(name: &str, offset: u32) -> Vec<Member>;
}

impl Field for f32 {
    fn members(name: &str, offset: u32) -> Vec<Member> {
        vec![(name.to_owned(), offset, ScalarKind::Float, 1)]
    }
}

impl Field for u32 {
    fn members(name: &str, offset: u32) -> Vec<Member> {
        vec![(name.to_owned(), offset, ScalarKind::Uint, 1)]
    }
}

impl Field for [f32; 3] {
    fn members(name: &str, offset: u32) -> Vec<Member> {
        vec![(name.to_owned(), offset, ScalarKind::Float, 3)]
    }
}

impl Field for [f32; 2] {
    fn members(name: &str, offset: u32) -> Vec<Member> {
        vec![(name.to_owned(), offset, ScalarKind::Float, 2)]
    }
}

/// Padding: `pad: [u32; 3]` is `pad0`, `pad1`, `pad2` in WGSL, whose arrays are wider.
impl<const N: usize> Field for [u32; N] {
    fn members(name: &str, offset: u32) -> Vec<Member> {
        let one = |i: u32| (format!("{name}{i}"), offset + 4 * i, ScalarKind::Uint, 1);
        (0..N as u32).map(one).collect()
    }
}

fn members_of<F: Field>(_: &F, name: &str, offset: usize) -> Vec<Member> {
    F::members(name, offset as u32)
}

/// A record of the host, and the name of its WGSL struct.
struct Record {
    wgsl: &'static str,
    size: u32,
    members: Vec<Member>,
}

macro_rules! record {
    ($host:ident as $wgsl:literal { $($field:ident),* $(,)? }) => {{
        // A pattern without `..`: a field that is not listed does not compile.
        let $host { $($field),* } = <$host as bytemuck::Zeroable>::zeroed();
        let mut members = Vec::new();
        $(members.extend(members_of(&$field, stringify!($field), offset_of!($host, $field)));)*
        Record { wgsl: $wgsl, size: size_of::<$host>() as u32, members }
    }};
}

fn records() -> Vec<Record> {
    vec![
        record!(NodeRecord as "Node" { low, skip, high, leaf }),
        record!(TriangleRecord as "Triangle" { a, material, b, index, c, kind }),
        record!(TextureRecord as "Texture" { first, width, height, sampler, scale, shift }),
        record!(MaterialRecord as "Material" { albedo, two_sided, emission, pad }),
        record!(PointRecord as "Point" { position, surface, normal, depth }),
        record!(VplRecord as "Vpl" { position, pad0, normal, bound, intensity, mean }),
        record!(BsdfRecord as "Bsdf" { specular, kind, parameter, lobe_probability, pad }),
        record!(GlossyVplRecord as "GlossyVpl" {
            position, shininess, normal, peak, intensity, mean, specular, specular_mean, mirrored,
            bound,
        }),
        record!(PointLightRecord as "PointLight" { position, before, intensity, probability }),
        record!(SpotLightRecord as "SpotLight" {
            position, before, intensity, probability, axis, cos_outer, slope, pad,
        }),
        record!(DirectionalLightRecord as "DirectionalLight" {
            toward, before, irradiance, probability,
        }),
        record!(DeltaLightRecord as "DeltaLight" {
            place, is_far, intensity, slope, axis, cos_outer,
        }),
        record!(SphereLightRecord as "SphereLight" {
            center, radius, radiance, two_sided, before, probability, pad,
        }),
        record!(AreaLightRecord as "AreaLight" {
            corner, before, edge1, probability, edge2, two_sided, normal, area, radiance, pad,
        }),
        record!(CameraParams as "CameraParams" {
            position, width, forward, height, right, first_block, up, sample, samples, seed,
            blocks, nodes, first_ray, rays, edge_rays, offset,
        }),
        record!(DirectParams as "DirectParams" {
            points, lights, first, count, seed, first_block, offset, nodes, sample, samples, rays,
            candidates, halves, area_density, solid_density, sky_density, most_rays,
            least_shininess, most_shininess, pad,
        }),
        record!(FilterParams as "FilterParams" {
            width, height, step, tolerance, rays, pad,
        }),
        record!(GuideParams as "GuideParams" {
            blocks, across, first_block, strata, seed, offset, nodes, is_piloted, even_sky, pad,
        }),
        record!(VisibilityParams as "VisibilityParams" {
            rows, vpls, first_word, matrix_word, offset, nodes, first, count, first_point, words, seed,
            pad,
        }),
        record!(ExpandParams as "ExpandParams" { rows, matrix_word, words, pad }),
        record!(ShadeParams as "ShadeParams" {
            points, rows, matrix_word, words, first_point, pad,
        }),
        record!(CorrectParams as "CorrectParams" {
            points, rows, matrix_word, words, first_point, rays, first_ray, seed, offset, nodes,
            chunk, chunks,
        }),
        record!(PathRecord as "Path" { throughput, stream }),
        record!(PathSum as "PathSum" { mean, shadow_rays, squares, pad }),
        record!(PathParams as "PathParams" {
            paths, bounce, first_sample, samples, lights, nodes, offset, light_density,
            background, solid_density, bound, lobe, quads, pad,
        }),
        record!(StartParams as "StartParams" { points, first_block, seed, paths }),
        record!(CompensatedParams as "CompensatedParams" { points, share, lobe, paths, first, halves, pad }),
        record!(ArrivalRecord as "Arrival" { diffuse, diffuse_g, glossy, glossy_g }),
        record!(InterleaveParams as "InterleaveParams" {
            width, height, s, rotation, subset_width, subset_points, points, axis,
        }),
    ]
}

/// The structs of a module by name: naga's span and members.
fn structs(module: &naga::Module) -> BTreeMap<String, (u32, Vec<Member>)> {
    let mut found = BTreeMap::new();
    for (_, ty) in module.types.iter() {
        let (Some(name), TypeInner::Struct { members, span }) = (&ty.name, &ty.inner) else {
            continue;
        };
        let member = |m: &naga::StructMember| {
            let (kind, count) = match module.types[m.ty].inner {
                TypeInner::Scalar(scalar) => (scalar.kind, 1),
                TypeInner::Vector { size, scalar } => (scalar.kind, size as u32),
                // No record has such a member: it equals none of the host's.
                _ => (ScalarKind::Bool, 0),
            };
            (m.name.clone().unwrap_or_default(), m.offset, kind, count)
        };
        found.insert(name.clone(), (*span, members.iter().map(member).collect()));
    }
    found
}

/// How often each record was compared; an error says what differs first.
fn compare(
    records: &[Record],
    modules: &[naga::Module],
) -> Result<BTreeMap<&'static str, u32>, String> {
    let mut compared: BTreeMap<_, _> = records.iter().map(|record| (record.wgsl, 0)).collect();
    for structs in modules.iter().map(structs) {
        for record in records {
            let Some((span, members)) = structs.get(record.wgsl) else { continue };
            if (*span, members) != (record.size, &record.members) {
                let Record { wgsl, size, members: host } = record;
                return Err(format!(
                    "{wgsl}: WGSL has {span} bytes, {members:?};\nthe host {size}, {host:?}"
                ));
            }
            *compared.entry(record.wgsl).or_default() += 1;
        }
    }
    match compared.iter().find(|(_, count)| **count == 0) {
        Some((name, _)) => Err(format!("no program has a struct {name}")),
        None => Ok(compared),
    }
}

fn all_modules() -> Vec<naga::Module> {
    all_programs().iter().map(|program| program.link().unwrap().module).collect()
}

#[test]
fn host_records_are_laid_out_as_naga_does() {
    let compared = compare(&records(), &all_modules()).unwrap_or_else(|what| panic!("{what}"));
    assert_eq!(compared.len(), 29, "{compared:?}");
}

#[test]
fn every_struct_in_a_buffer_has_a_host_record() {
    let known: Vec<_> = records().iter().map(|record| record.wgsl).collect();
    let mut seen = 0;
    for module in all_modules() {
        for (_, global) in module.global_variables.iter().filter(|(_, g)| g.binding.is_some()) {
            let mut ty = &module.types[global.ty];
            while let TypeInner::Array { base, .. } = ty.inner {
                ty = &module.types[base];
            }
            if let TypeInner::Struct { .. } = ty.inner {
                let name = ty.name.as_deref().unwrap_or("?");
                assert!(known.contains(&name), "{name} in {:?} has no host record", global.name);
                seen += 1;
            }
        }
    }
    assert!(seen > 11, "only {seen} buffers of structs");
}

/// `trace/wide_nodes.wgsl` is read by four words, nodes and triangles alike.
#[test]
fn packets_find_the_children_of_nodes() {
    assert_eq!((size_of::<WideNode>(), size_of::<WideChild>()), (8 * 16, 2 * 16));
    assert_eq!([offset_of!(WideChild, low), offset_of!(WideChild, high)], [0, 16]);
    assert_eq!(offset_of!(WideChild, link), 12);
    let last = [offset_of!(TriangleRecord, material), offset_of!(TriangleRecord, index)];
    assert_eq!((last, offset_of!(TriangleRecord, kind)), ([12, 28], 44));
}

/// `lights/strata.wgsl`, `lights/area_light.wgsl` and `lights/sphere_light.wgsl` read their tables by
/// four words.
#[test]
fn lights_are_found_in_their_tables() {
    type Stratum = LightStratumRecord;
    let stratum =
        [offset_of!(Stratum, low), offset_of!(Stratum, extent), offset_of!(Stratum, kind)];
    assert_eq!((size_of::<Stratum>(), stratum), (2 * 16, [0, 8, 16]));
    type Area = AreaLightRecord;
    let rows = [
        [offset_of!(Area, corner), offset_of!(Area, before)],
        [offset_of!(Area, edge1), offset_of!(Area, probability)],
        [offset_of!(Area, edge2), offset_of!(Area, two_sided)],
        [offset_of!(Area, normal), offset_of!(Area, area)],
    ];
    let radiance = offset_of!(Area, radiance);
    assert_eq!((rows, radiance), ([[0, 12], [16, 28], [32, 44], [48, 60]], 64));
    assert_eq!(size_of::<Area>(), 5 * 16);
    type Sphere = SphereLightRecord;
    let place = [offset_of!(Sphere, center), offset_of!(Sphere, radius)];
    let emission = [offset_of!(Sphere, radiance), offset_of!(Sphere, two_sided)];
    let choice = [offset_of!(Sphere, before), offset_of!(Sphere, probability)];
    assert_eq!([place, emission, choice], [[0, 12], [16, 28], [32, 36]]);
    assert_eq!(size_of::<Sphere>(), 3 * 16);
}

#[test]
fn a_record_that_differs_is_seen() {
    let host = || vec![record!(PointRecord as "Point" { position, surface, normal, depth })];
    let parse = |source: &str| vec![naga::front::wgsl::parse_str(source).unwrap()];
    let good = "struct Point { position: vec3f, surface: u32, normal: vec3f, depth: f32 }";
    assert_eq!(compare(&host(), &parse(good)).unwrap()["Point"], 1);
    for (from, to) in [
        // Moved, renamed, of another type, longer, shorter, under another name, absent.
        ("position: vec3f, surface: u32", "surface: u32, position: vec3f"),
        ("normal", "direction"),
        ("surface: u32", "surface: f32"),
        ("position: vec3f, surface", "position: vec3u, surface"),
        ("depth: f32", "depth: f32, more: f32"),
        (", depth: f32", ""),
        ("struct Point", "struct Points"),
        (good, "const X = 1;"),
    ] {
        let bad = good.replace(from, to);
        assert_ne!(bad, good);
        assert!(compare(&host(), &parse(&bad)).is_err(), "not seen: {bad}");
    }
    assert!(compare(&host(), &[]).is_err(), "nothing compared, nothing said");
}
