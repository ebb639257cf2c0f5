//! The files of `shaders/` as modules to link, and the features of scenes and settings that they
//! serve.

use crate::gpu::{Module, Program};

macro_rules! modules {
    (@feature) => { None };
    (@feature $feature:literal) => { Some($feature) };
    ($($constant:ident = $name:literal $(for $feature:literal)?;)*) => {
        $(
            #[doc = concat!("`shaders/", $name, ".wgsl`")]
            pub static $constant: Module = Module {
                name: $name,
                source: include_str!(concat!("../../../shaders/", $name, ".wgsl")),
                feature: modules!(@feature $($feature)?),
            };
        )*
        /// Every module that some scene links. Its order is that of `left_out` in reports.
        pub static CATALOGUE: &[&Module] = &[$(&$constant),*];
    };
}

modules! {
    TYPES = "common/types";
    SAMPLING = "common/sampling";
    PIXELS = "common/pixels";
    TABLE = "common/table";
    MEAN = "common/mean";
    SHAPE_TRIANGLE = "trace/shape_triangle";
    SHAPE_ANY = "trace/shape_any" for "spheres";
    OPAQUE_ALL = "trace/opaque_all";
    OPAQUE_CUTOUT = "trace/opaque_cutout" for "alpha cut-outs";
    TEXTURE = "materials/texture";
    UV_TRIANGLE = "trace/uv_triangle";
    UV_ANY = "trace/uv_any" for "spheres";
    UV_DIFFERENCE = "trace/uv_difference";
    UV_DIFFERENCE_TRIANGLE = "trace/uv_difference_triangle";
    UV_DIFFERENCE_ANY = "trace/uv_difference_any" for "spheres";
    ALBEDO_PLAIN = "materials/albedo_plain";
    HEMISPHERE = "common/hemisphere";
    BSDF = "materials/bsdf";
    VIEW_DIRECTION_NONE = "camera/view_direction_none";
    VIEW_DIRECTION = "camera/view_direction";
    RAY_OFFSET = "trace/ray_offset";
    PHONG = "materials/phong" for "phong";
    GATHERED_DIFFUSE = "materials/gathered_diffuse";
    GATHERED_PHONG = "materials/gathered_phong" for "phong";
    ALBEDO_TEXTURED = "materials/albedo_textured" for "textures";
    STORE_ALBEDO_NONE = "camera/store_albedo_none";
    STORE_ALBEDO = "camera/store_albedo" for "textures";
    MATERIAL_TEXTURES = "materials/material_textures";
    VERTEX_COLOR = "materials/vertex_color" for "vertex colours";
    VERTEX_COLOR_NONE = "materials/vertex_color_none";
    MATERIAL_TEXTURES_FILTERED = "materials/material_textures_filtered";
    FOOTPRINT = "materials/footprint";
    TEXTURE_FILTERED = "materials/texture_filtered";
    EMISSION_SCALE_NONE = "materials/emission_scale_none";
    EMISSION_SCALE_TEXTURED = "materials/emission_scale_textured" for "emission textures";
    EMISSION_SCALE_AT_NONE = "materials/emission_scale_at_none";
    EMISSION_SCALE_AT = "materials/emission_scale_at" for "emission textures";
    STORE_EMISSION_SCALE_NONE = "camera/store_emission_scale_none";
    STORE_EMISSION_SCALE = "camera/store_emission_scale" for "emission textures";
    LIGHT_SCALE_NONE = "lights/light_scale_none";
    LIGHT_SCALE_TEXTURED = "lights/light_scale_textured" for "emission textures";
    LOBE_ENERGY = "materials/lobe_energy";
    LOBES_DIFFUSE = "materials/lobes_diffuse";
    LOBES_PHONG = "materials/lobes_phong" for "phong";
    LOBE_SAMPLE = "materials/lobe_sample" for "phong";
    SCATTER_DIFFUSE = "materials/scatter_diffuse";
    SCATTER_PHONG = "materials/scatter_phong" for "phong";
    SPECULAR_SAMPLE = "materials/specular_sample";
    MIRROR = "materials/mirror" for "mirror";
    GLASS = "materials/glass" for "glass";
    SAMPLE_SPECULAR_MIRROR = "materials/sample_specular_mirror" for "mirror";
    SAMPLE_SPECULAR_GLASS = "materials/sample_specular_glass" for "glass";
    SAMPLE_SPECULAR_EITHER = "materials/sample_specular_either";
    SPECULAR_CHAIN_NONE = "materials/specular_chain_none";
    SPECULAR_CHAIN = "materials/specular_chain";
    STORE_THROUGHPUT_NONE = "camera/store_throughput_none";
    STORE_THROUGHPUT = "camera/store_throughput";
    THROUGHPUT_NONE = "camera/throughput_none";
    THROUGHPUT_STORED = "camera/throughput_stored";
    THROUGHPUT_PATH = "camera/throughput_path";
    REFLECTANCE_PLAIN = "materials/reflectance_plain";
    REFLECTANCE_ANY = "materials/reflectance_any";
    RESOLVE = "camera/resolve";
    VPL_DIFFUSE = "visibility/vpl_diffuse";
    VPL_GLOSSY = "visibility/vpl_glossy" for "phong";
    RAY = "trace/ray";
    TRAVERSE = "trace/traverse" for "bounding volume hierarchy";
    WIDE_NODES = "trace/wide_nodes" for "bounding volume hierarchy";
    TRAVERSE_PACKET = "trace/traverse_packet" for "bounding volume hierarchy";
    LITERALS = "trace/literals" for "triangles as literals";
    HIT_TRIANGLES = "trace/hit_triangles";
    CAMERA = "camera/camera";
    HIT_POINT = "trace/hit_point";
    ONE_SURFACE = "common/one_surface";
    POINT_RAY = "camera/point_ray";
    POINT_RAY_OWN = "camera/point_ray_own";
    POINT_RAY_ANY = "camera/point_ray_any" for "antialiasing of edges";
    BEAM = "camera/beam" for "antialiasing of edges";
    BEAM_PACKET = "camera/beam_packet" for "bounding volume hierarchy";
    BEAM_EACH = "camera/beam_each" for "antialiasing of edges";
    PIXEL_RAYS = "camera/pixel_rays" for "antialiasing of edges";
    PIXELS_AROUND = "camera/pixels_around" for "antialiasing of edges";
    SEEN_SURFACE = "camera/seen_surface" for "antialiasing of edges";
    RAY_CODES = "camera/ray_codes" for "antialiasing of edges";
    RAY_SURFACES = "camera/ray_surfaces" for "antialiasing of edges";
    STORED_RAYS = "camera/stored_rays" for "antialiasing of edges";
    RAY_LIGHT_NONE = "camera/ray_light_none";
    RAY_LIGHT = "camera/ray_light";
    RAY_EMISSION_NONE = "camera/ray_emission_none";
    RAY_EMISSION = "camera/ray_emission" for "emission";
    RAY_EMISSION_SCALE_NONE = "camera/ray_emission_scale_none";
    RAY_EMISSION_SCALE = "camera/ray_emission_scale" for "emission textures";
    RAY_BACKGROUND_NONE = "camera/ray_background_none";
    RAY_BACKGROUND = "camera/ray_background" for "environment light";
    RAY_THROUGHPUT_NONE = "camera/ray_throughput_none";
    RAY_THROUGHPUT = "camera/ray_throughput";
    FIRST_RAYS = "camera/first_rays" for "antialiasing of edges";
    UNSEEN_SURFACES = "camera/unseen_surfaces" for "antialiasing of edges";
    REPLACE_POINTS = "camera/replace_points" for "antialiasing of edges";
    LINK_RAYS = "camera/link_rays" for "antialiasing of edges";
    RADIANCE_CODE = "camera/radiance_code" for "antialiasing of edges";
    FIRST_RADIANCE = "camera/first_radiance" for "antialiasing of edges";
    RESOLVE_RAYS = "camera/resolve_rays" for "antialiasing of edges";
    PIXEL_LIST = "camera/pixel_list" for "antialiasing of edges";
    ANTIALIAS = "camera/antialias" for "antialiasing of edges";
    VISIBLE_POINTS = "camera/visible_points";
    DIRECT_PARAMS = "direct/params" for "direct light";
    CHOOSE_LIGHT = "lights/choose_light";
    LIGHT_SAMPLE = "lights/light_sample";
    LOCAL_LIGHT = "lights/local_light";
    POINT_LIGHT = "lights/point_light" for "point lights";
    SPOT_LIGHT = "lights/spot_light" for "spot lights";
    DIRECTIONAL_LIGHT = "lights/directional_light" for "directional lights";
    DIRECT_EXACT = "direct/exact";
    AREA_LIGHT = "lights/area_light" for "area lights";
    TRIANGLE_AREA = "lights/triangle_area" for "area lights";
    TRIANGLE_SOLID_ANGLE = "lights/triangle_solid_angle" for "area lights near surfaces";
    SPHERE_CONE = "lights/sphere_cone" for "sphere lights";
    SPHERE_LIGHT = "lights/sphere_light" for "sphere lights";
    PATH_EMISSION_ANY = "path/emission_any" for "sphere lights";
    ENVIRONMENT_CONSTANT = "lights/environment_constant" for "environment light";
    ENVIRONMENT_IMAGE = "lights/environment_image" for "environment images";
    ENVIRONMENT_CELLS = "lights/environment_cells" for "environment images";
    ENVIRONMENT_LIGHT_CONSTANT = "lights/environment_light_constant" for "environment light";
    ENVIRONMENT_LIGHT_IMAGE = "lights/environment_light_image" for "environment images";
    BACKGROUND = "camera/background" for "environment light";
    PATH_FOUND = "path/found" for "path tracing";
    PATH_BACKGROUND = "path/background" for "environment light";
    PATH_BACKGROUND_WEIGHTED = "path/background_weighted" for "environment images";
    PATH_BACKGROUND_NONE = "path/background_none";
    AREA_LIGHT_NONE = "lights/area_light_none";
    SPHERE_LIGHT_NONE = "lights/sphere_light_none";
    ENVIRONMENT_LIGHT_NONE = "lights/environment_light_none";
    ONLY_AREA = "lights/only_area";
    ONLY_SPHERE = "lights/only_sphere";
    ONLY_ENVIRONMENT = "lights/only_environment";
    LIGHT_KINDS = "lights/kinds";
    SEVERAL_KINDS = "lights/several_kinds";
    LIGHT_STRATA = "lights/strata";
    DELTA_LIGHT = "lights/delta_light" for "many lights without extent";
    STRATUM_EXTENDED = "lights/stratum_extended";
    STRATUM_DELTA = "lights/stratum_delta" for "many lights without extent";
    STRATUM_ANY = "lights/stratum_any" for "many lights without extent";
    CHOOSE_STRATUM = "direct/choose_stratum" for "guided light samples";
    CHOOSE_STRATUM_EVEN = "direct/choose_stratum_even";
    GUIDE_PARAMS = "direct/guide_params" for "guided light samples";
    GUIDE_UNSHADOWED = "direct/guide_unshadowed" for "guided light samples";
    GUIDE_PILOT = "direct/guide_pilot" for "guided light samples";
    GUIDE = "direct/guide" for "guided light samples";
    PACK_SURFACES = "direct/pack_surfaces" for "filter of direct light";
    FILTER_PARAMS = "direct/filter_params" for "filter of direct light";
    FILTER_SURFACES = "direct/filter_surfaces" for "filter of direct light";
    RAY_COUNTS = "direct/ray_counts" for "filter of direct light";
    PACK_LIGHT = "direct/pack_light" for "filter of direct light";
    FILTER_GUIDE = "direct/filter_guide" for "filter of direct light";
    FILTER_NEAR = "direct/filter_near" for "filter of direct light";
    FILTER_FAR = "direct/filter_far" for "filter of direct light";
    FILTER_LEVEL = "direct/filter_level" for "filter of direct light";
    RAYS_ALIKE = "direct/rays_alike";
    RAYS_COUNTED = "direct/rays_counted" for "filter of direct light";
    RECEIVER_PLAIN = "direct/receiver_plain";
    RECEIVER_LOBED = "direct/receiver_lobed" for "phong";
    DIRECT_SAMPLED = "direct/sampled";
    EMITTED_NONE = "direct/emitted_none";
    EMITTED = "direct/emitted" for "area lights";
    EMITTED_ANY = "direct/emitted_any" for "sphere lights";
    ESCAPING_NONE = "direct/escaping_none";
    ESCAPING = "direct/escaping" for "environment light";
    LOBE_RAYS = "direct/lobe_rays" for "phong";
    VISIBILITY_SINGLE = "visibility/single" for "gathering of lights";
    VISIBILITY_LIGHTS = "visibility/lights" for "gathering of lights";
    VISIBILITY_PARAMS = "visibility/params" for "gathering of lights";
    BITS = "visibility/bits" for "gathering of lights";
    PACKET_SHAFT = "trace/packet_shaft" for "bounding volume hierarchy";
    PACKET_RAYS = "trace/packet_rays" for "bounding volume hierarchy";
    BLOCKER_TRIANGLE = "trace/blocker_triangle";
    BLOCKER_ANY = "trace/blocker_any";
    PACKET_SEGMENTS = "visibility/packet_segments" for "bounding volume hierarchy";
    VISIBILITY_PACKET = "visibility/packet" for "gathering of lights";
    LITERAL_SEGMENTS = "visibility/literal_segments" for "triangles as literals";
    VISIBILITY_LITERALS = "visibility/literals" for "triangles as literals";
    MEMBER_DIFFUSE = "visibility/member_diffuse" for "visibility shared by VPL clusters";
    MEMBER_GLOSSY = "visibility/member_glossy" for "phong";
    WEIGHT_DIFFUSE = "visibility/weight_diffuse" for "visibility shared by VPL clusters";
    WEIGHT_GLOSSY = "visibility/weight_glossy" for "phong";
    DRAW_MEMBERS = "visibility/draw_members" for "visibility shared by VPL clusters";
    MEMBERS = "visibility/members" for "visibility shared by VPL clusters";
    MEMBERS_SINGLE = "visibility/members_single" for "visibility shared by VPL clusters";
    MEMBERS_PACKET = "visibility/members_packet" for "visibility shared by VPL clusters";
    MEMBERS_LITERALS = "visibility/members_literals" for "triangles as literals";
    EXPAND_PARAMS = "visibility/expand_params" for "visibility shared by VPL clusters";
    PACK_COLUMNS = "visibility/pack_columns" for "visibility shared by VPL clusters";
    EXPAND = "visibility/expand" for "visibility shared by VPL clusters";
    SUBSETS = "gather/subsets" for "interleaved sampling";
    SPLIT_SUBSETS = "gather/split_subsets" for "interleaved sampling";
    SIGNATURE_NONE = "gather/signature_none";
    SIGNATURE_PROBED = "gather/signature_probed" for "probes of visibility";
    COMPENSATION_NONE = "gather/compensation_none";
    COMPENSATION_ADDED = "gather/compensation_added" for "bias compensation";
    SURFACE_PLAIN = "gather/surface_plain";
    SURFACE_LOBED = "gather/surface_lobed" for "phong";
    SURFACE_LOBE_CODE = "gather/surface_lobe_code" for "phong";
    LIGHT_TABLE = "gather/light_table";
    LIGHT_TO_TABLE = "gather/light_to_table";
    LIGHT_TO_POINTS = "gather/light_to_points";
    JOIN_SUBSETS = "gather/join_subsets" for "interleaved sampling";
    DISCONTINUITY_BUFFER = "gather/discontinuity_buffer" for "interleaved sampling";
    SEEN_HARD = "gather/seen_hard";
    SEEN_FUZZY = "gather/seen_fuzzy" for "fuzzy clusters";
    ROW_POINT = "gather/row_point";
    ROW_CLUSTER = "gather/row_cluster" for "hard clusters";
    EMITTER_SURFACE = "visibility/emitter_surface" for "virtual point lights";
    EMITTER_POINT = "visibility/emitter_point" for "point lights";
    GATHER_PARAMS = "gather/params" for "gathering of lights";
    SHADE = "gather/shade" for "gathering of lights";
    SHADE_COOPERATIVE = "gather/shade_cooperative" for "gathering of lights";
    CORRECT_PARAMS = "gather/correct_params" for "corrected visibility";
    CORRECT_DRAW = "gather/correct_draw" for "corrected visibility";
    CORRECT_EACH = "gather/correct_each" for "corrected visibility";
    CORRECT_COOPERATIVE = "gather/correct_cooperative" for "corrected visibility";
    CORRECT = "gather/correct" for "corrected visibility";
    PAIR_DIFFUSE = "gather/pair_diffuse";
    PAIR_GLOSSY = "gather/pair_glossy" for "phong";
    SHADE_GLOSSY = "gather/shade_glossy" for "phong";
    PAIR_BOUNDED = "gather/pair_bounded" for "clamp";
    PAIR_UNBOUNDED = "gather/pair_unbounded";
    PATH_PARAMS = "path/params" for "path tracing";
    PATH_STATE = "path/state" for "path tracing";
    PATH_RANDOM = "path/random" for "path tracing";
    PATH_CAMERA = "path/camera" for "path tracing";
    PATH_LIGHT = "path/light" for "direct light";
    PATH_CONTRIBUTION = "path/contribution" for "path tracing";
    PATH_EXACT = "path/exact";
    PATH_SAMPLED = "path/sampled";
    ROULETTE = "common/roulette" for "Russian roulette";
    ROULETTE_NONE = "common/roulette_none";
    MIS = "common/mis";
    PATH_EMISSION = "path/emission" for "area lights";
    PATH_EMISSION_NONE = "path/emission_none";
    PATH_FOLLOW = "path/follow";
    PATH_SEGMENT = "path/segment" for "path tracing";
    PATH_COUNT = "path/count" for "path tracing";
    PATH_COMPACT = "path/compact" for "path tracing";
    PATH_SUM = "path/sum" for "path tracing";
    SEEN_ALL = "compensation/seen_all" for "bias compensation";
    COMPENSATION_SHARE = "compensation/share" for "bias compensation";
    COMPENSATION_BOUND = "compensation/bound" for "bias compensation";
    COMPENSATION_START = "compensation/start" for "bias compensation";
    COMPENSATION_DIFFUSE = "compensation/diffuse";
    COMPENSATION_GLOSSY = "compensation/glossy" for "phong";
    COMPENSATION_SURVIVAL = "compensation/survival" for "bias compensation";
    SIGHT_NONE = "compensation/sight_none";
    SIGHT_COLUMNS = "compensation/sight_columns" for "bias compensation";
    VPL_TABLE = "compensation/vpl_table" for "bias compensation";
    VPL_TABLE_GLOSSY = "compensation/vpl_table_glossy" for "phong";
    COMPENSATION_CONTRIBUTION = "compensation/contribution" for "bias compensation";
    COMPENSATION_VPLS = "compensation/vpls" for "bias compensation";
    COMPENSATION_SEGMENT = "compensation/segment" for "bias compensation";
    COMPENSATION_ADD = "compensation/add" for "bias compensation";
    EMIT = "camera/emit" for "emission";
    REFLECT = "gather/reflect" for "reflection";
    CLAMPED_ENERGY = "gather/clamped_energy" for "clamp";
    SHOW_NORMAL = "camera/show_normal" for "normal";
    SHOW_DEPTH = "camera/show_depth" for "depth";
    SHOW_ALBEDO = "camera/show_albedo" for "albedo";
}

/// Features that some module of the programs serves, in the order of the catalogue.
pub fn features_of<'a>(programs: impl Iterator<Item = &'a Program>) -> Vec<&'static str> {
    let served = |program: &'a Program| program.modules.iter().filter_map(|module| module.feature);
    let linked: Vec<_> = programs.flat_map(served).collect();
    features().into_iter().filter(|feature| linked.contains(feature)).collect()
}

/// Features that no module of the programs serves, in the order of the catalogue.
pub fn features_without<'a>(programs: impl Iterator<Item = &'a Program>) -> Vec<&'static str> {
    let linked = features_of(programs);
    features().into_iter().filter(|feature| !linked.contains(feature)).collect()
}

/// All features, each once, in the order of the catalogue.
fn features() -> Vec<&'static str> {
    let mut features = Vec::new();
    for feature in CATALOGUE.iter().filter_map(|module| module.feature) {
        if !features.contains(&feature) {
            features.push(feature);
        }
    }
    features
}
