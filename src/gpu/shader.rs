//! Shaders as ordered lists of WGSL files. What a scene does not need is not in the list.

use std::sync::Arc;

use naga::valid::{Capabilities, ValidationFlags, Validator};

use super::GpuError;

/// One WGSL file.
#[derive(Debug, PartialEq, Eq)]
pub struct Module {
    /// The file's name without its ending.
    pub name: &'static str,
    /// Its text.
    pub source: &'static str,
    /// The feature of a scene or of the settings without which it is left out.
    pub feature: Option<&'static str>,
}

macro_rules! modules {
    (@feature) => { None };
    (@feature $feature:literal) => { Some($feature) };
    ($($constant:ident = $name:literal $(for $feature:literal)?;)*) => {
        $(
            #[doc = concat!("`shaders/", $name, ".wgsl`")]
            pub static $constant: Module = Module {
                name: $name,
                source: include_str!(concat!("../../shaders/", $name, ".wgsl")),
                feature: modules!(@feature $($feature)?),
            };
        )*
        /// Every module that some scene links.
        pub static CATALOGUE: &[&Module] = &[$(&$constant),*];
    };
}

/// The modules, by the names of their files.
pub mod module {
    use super::Module;

    modules! {
        TYPES = "types";
        SAMPLING = "sampling";
        PIXELS = "pixels";
        SHAPE_TRIANGLE = "shape_triangle";
        SHAPE_ANY = "shape_any" for "spheres";
        OPAQUE_ALL = "opaque_all";
        OPAQUE_CUTOUT = "opaque_cutout" for "alpha cut-outs";
        TEXTURE = "texture";
        UV_TRIANGLE = "uv_triangle";
        UV_ANY = "uv_any" for "spheres";
        ALBEDO_PLAIN = "albedo_plain";
        HEMISPHERE = "hemisphere";
        FINISH = "finish";
        VIEW_NONE = "view_none";
        VIEW_KEPT = "view_kept";
        WAY_BACK = "way_back";
        PHONG = "phong" for "phong";
        GATHERED_DIFFUSE = "gathered_diffuse";
        GATHERED_PHONG = "gathered_phong" for "phong";
        ALBEDO_TEXTURED = "albedo_textured" for "textures";
        KEEP_ALBEDO_NONE = "keep_albedo_none";
        KEEP_ALBEDO = "keep_albedo" for "textures";
        MATERIAL_TEXTURES = "material_textures";
        GLOW_NONE = "glow_none";
        GLOW_TEXTURED = "glow_textured" for "emission textures";
        KEEP_GLOW_NONE = "keep_glow_none";
        KEEP_GLOW = "keep_glow" for "emission textures";
        LIGHT_PLAIN = "light_plain";
        LIGHT_TEXTURED = "light_textured" for "emission textures";
        LOBE_ENERGY = "lobe_energy";
        LOBES_DIFFUSE = "lobes_diffuse";
        LOBES_PHONG = "lobes_phong" for "phong";
        SCATTER_DIFFUSE = "scatter_diffuse";
        SCATTER_PHONG = "scatter_phong" for "phong";
        TURN = "turn";
        MIRROR = "mirror" for "mirror";
        GLASS = "glass" for "glass";
        TURN_MIRROR = "turn_mirror" for "mirror";
        TURN_GLASS = "turn_glass" for "glass";
        TURN_EITHER = "turn_either";
        FOLLOW_NONE = "follow_none";
        FOLLOW_SPECULAR = "follow_specular";
        KEEP_THROUGHPUT_NONE = "keep_throughput_none";
        KEEP_THROUGHPUT = "keep_throughput";
        THROUGHPUT_NONE = "throughput_none";
        THROUGHPUT_KEPT = "throughput_kept";
        THROUGHPUT_PATH = "throughput_path";
        REFLECTANCE_PLAIN = "reflectance_plain";
        REFLECTANCE_ANY = "reflectance_any";
        RESOLVE = "resolve";
        VPL_DIFFUSE = "vpl_diffuse";
        VPL_GLOSSY = "vpl_glossy" for "phong";
        RAY = "ray";
        TRAVERSE = "traverse" for "bounding volume hierarchy";
        TRAVERSE_PACKET = "traverse_packet" for "bounding volume hierarchy";
        LITERAL_RAY = "literal_ray" for "triangles as literals";
        CORNERS = "corners";
        CAMERA = "camera";
        HIT_POINT = "hit_point";
        ONE_SURFACE = "one_surface";
        ANTIALIAS = "antialias" for "antialiasing of edges";
        VISIBLE = "visible_points";
        DIRECT = "direct" for "direct light";
        CHOOSE_LIGHT = "choose_light";
        LIGHT_SAMPLE = "light_sample";
        LOCAL_LIGHT = "local_light";
        POINT_LIGHT = "point_light" for "point lights";
        SPOT_LIGHT = "spot_light" for "spot lights";
        DIRECTIONAL_LIGHT = "directional_light" for "directional lights";
        DIRECT_EXACT = "direct_exact";
        AREA_LIGHT = "area_light" for "area lights";
        PLACE_BY_AREA = "place_by_area" for "area lights";
        PLACE_BY_ANGLE = "place_by_angle" for "area lights near surfaces";
        SPHERE_CONE = "sphere_cone" for "sphere lights";
        SPHERE_LIGHT = "sphere_light" for "sphere lights";
        PATH_EMISSION_ANY = "path_emission_any" for "sphere lights";
        ENVIRONMENT_CONSTANT = "environment_constant" for "environment light";
        ENVIRONMENT_IMAGE = "environment_image" for "environment images";
        ENVIRONMENT_CELLS = "environment_cells" for "environment images";
        ENVIRONMENT_LIGHT_CONSTANT = "environment_light_constant" for "environment light";
        ENVIRONMENT_LIGHT_IMAGE = "environment_light_image" for "environment images";
        BACKGROUND = "background" for "environment light";
        UNSEEN_NONE = "unseen_none";
        UNSEEN_BACKGROUND = "unseen_background" for "environment light";
        PATH_FOUND = "path_found" for "path tracing";
        PATH_BACKGROUND = "path_background" for "environment light";
        PATH_BACKGROUND_WEIGHTED = "path_background_weighted" for "environment images";
        PATH_NO_BACKGROUND = "path_no_background";
        DRAW_ONE = "draw_one";
        DRAW_RESAMPLED = "draw_resampled" for "many area lights";
        DIRECT_SAMPLED = "direct_sampled";
        VISIBILITY = "visibility" for "gathering of lights";
        BITS = "bits" for "gathering of lights";
        PACKET_SHAFT = "packet_shaft" for "bounding volume hierarchy";
        PACKET_RAYS = "packet_rays" for "bounding volume hierarchy";
        BLOCKER_TRIANGLE = "blocker_triangle";
        BLOCKER_ANY = "blocker_any";
        VISIBILITY_PACKET = "visibility_packet" for "gathering of lights";
        VISIBILITY_LITERALS = "visibility_literals" for "triangles as literals";
        EXPAND = "expand" for "visibility shared by VPL clusters";
        INTERLEAVED = "interleaved" for "interleaved sampling";
        SEPARATE = "separate" for "interleaved sampling";
        SIGNATURE_NONE = "signature_none";
        SIGNATURE_PROBED = "signature_probed" for "probes of visibility";
        GIVEN_NONE = "given_none";
        GIVEN_BACK = "given_back" for "bias compensation";
        SURFACE_PLAIN = "surface_plain";
        SURFACE_LOBED = "surface_lobed" for "phong";
        SURFACE_LOBE_CODE = "surface_lobe_code" for "phong";
        COLLECT = "collect" for "interleaved sampling";
        COMBINE = "combine" for "interleaved sampling";
        SEEN_HARD = "seen_hard";
        SEEN_FUZZY = "seen_fuzzy" for "fuzzy clusters";
        ROW_POINT = "row_point";
        ROW_CLUSTER = "row_cluster" for "hard clusters";
        EMITTER_SURFACE = "emitter_surface" for "virtual point lights";
        EMITTER_POINT = "emitter_point" for "point lights";
        GATHER = "gather" for "gathering of lights";
        SHADE = "shade" for "gathering of lights";
        SHADE_COOPERATIVE = "shade_cooperative" for "gathering of lights";
        PAIR_DIFFUSE = "pair_diffuse";
        PAIR_GLOSSY = "pair_glossy" for "phong";
        SHADE_GLOSSY = "shade_glossy" for "phong";
        PAIR_BOUNDED = "pair_bounded" for "clamp";
        PAIR_UNBOUNDED = "pair_unbounded";
        PATH = "path" for "path tracing";
        PATH_STATE = "path_state" for "path tracing";
        PATH_RANDOM = "path_random" for "path tracing";
        PATH_CAMERA = "path_camera" for "path tracing";
        PATH_LIGHT = "path_light" for "direct light";
        PATH_BACK = "path_back" for "path tracing";
        PATH_EXACT = "path_exact";
        PATH_SAMPLED = "path_sampled";
        ROULETTE = "roulette" for "Russian roulette";
        NO_ROULETTE = "no_roulette";
        MIS = "mis";
        PATH_EMISSION = "path_emission" for "area lights";
        PATH_NO_EMISSION = "path_no_emission";
        PATH_FOLLOW = "path_follow";
        PATH_SEGMENT = "path_segment" for "path tracing";
        PATH_COUNT = "path_count" for "path tracing";
        PATH_COMPACT = "path_compact" for "path tracing";
        PATH_SUM = "path_sum" for "path tracing";
        SEEN_ALL = "seen_all" for "bias compensation";
        COMPENSATE_SHARE = "compensate_share" for "bias compensation";
        COMPENSATE_START = "compensate_start" for "bias compensation";
        COMPENSATE_DIFFUSE = "compensate_diffuse";
        COMPENSATE_GLOSSY = "compensate_glossy" for "phong";
        COMPENSATE_BACK = "compensate_back" for "bias compensation";
        COMPENSATE_VPLS = "compensate_vpls" for "bias compensation";
        COMPENSATE_SEGMENT = "compensate_segment" for "bias compensation";
        COMPENSATED = "compensated" for "bias compensation";
        EMIT = "emit" for "emission";
        REFLECT = "reflect" for "reflection";
        REMOVED = "removed" for "clamp";
        SHOW_NORMAL = "show_normal" for "normal";
        SHOW_DEPTH = "show_depth" for "depth";
        SHOW_ALBEDO = "show_albedo" for "albedo";
    }
}

pub use module::CATALOGUE;

/// The files of a kernel, in order.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Program {
    /// The kernel's name in reports and debuggers.
    pub label: &'static str,
    /// Its files; the last has the entry point `main`.
    pub modules: Vec<&'static Module>,
    /// What is written for one scene, and follows the files.
    pub generated: Option<Arc<str>>,
}

/// A program that has been parsed and validated.
#[derive(Debug)]
pub struct Linked {
    /// The whole source.
    pub source: String,
    /// naga's form of it.
    pub module: naga::Module,
    /// Name and binding of each resource that the entry point uses, all of group 0.
    pub bindings: Vec<(String, u32)>,
}

impl Program {
    /// Of files, each of which is linked once, where it first stands.
    pub fn new(label: &'static str, modules: Vec<&'static Module>) -> Self {
        let mut once: Vec<&'static Module> = Vec::with_capacity(modules.len());
        for module in modules {
            if !once.contains(&module) {
                once.push(module);
            }
        }
        Self { label, modules: once, generated: None }
    }

    /// Joins the files, parses and validates them, and finds what they bind.
    ///
    /// # Errors
    /// A file does not parse, or the whole is not valid: a fault of this program, named with
    /// file and line.
    pub fn link(&self) -> Result<Linked, GpuError> {
        let files = self.modules.iter().map(|module| module.source);
        let source = files.chain(self.generated.as_deref()).collect::<Vec<_>>().join("\n");
        let module = naga::front::wgsl::parse_str(&source).map_err(|error| {
            let line = error.location(&source).map_or(0, |l| l.line_number as usize);
            GpuError::Invalid(format!("{}: {}", self.place(line), error.message()))
        })?;
        let mut validator = Validator::new(ValidationFlags::all(), Capabilities::SUBGROUP);
        let info = validator.validate(&module).map_err(|error| {
            let line = error.location(&source).map_or(0, |l| l.line_number as usize);
            GpuError::Invalid(format!("{}: {:?}", self.place(line), error.into_inner()))
        })?;
        let entry = info.get_entry_point(0);
        let bindings = module
            .global_variables
            .iter()
            .filter(|(handle, _)| !entry[*handle].is_empty())
            .filter_map(|(_, global)| Some((global.name.clone()?, global.binding?.binding)))
            .collect();
        Ok(Linked { source, module, bindings })
    }

    /// File and line of a line of the joined source.
    fn place(&self, mut line: usize) -> String {
        for module in &self.modules {
            let lines = module.source.matches('\n').count() + 1;
            if line <= lines {
                return format!("{}.wgsl:{line}", module.name);
            }
            line -= lines;
        }
        format!("{}, generated:{line}", self.label)
    }
}
