// The scene of whitted.toml for POV-Ray 3.7, which is left-handed: z runs the other way.
// povray +Iwhitted.pov +W1920 +H1080 -A +WT2 -D
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 8 }
camera { location <0, 2.2, -7> look_at <0, 0.9, 0> right x*image_width/image_height angle 45 }
background { color rgb <0.45, 0.6, 0.85> }
light_source { <-4, 6, -5> color rgb 0.55 }
light_source {
  <3, 5, -2> color rgb 0.75
  area_light <1.5, 0, 0>, <0, 0, 1.5>, 4, 4 jitter circular orient
}
plane { y, 0 pigment { checker rgb 0.9, rgb 0.12 } finish { diffuse 0.8 ambient 0.08 } }
sphere {
  <-1.4, 1, 0.4>, 1
  pigment { rgb 0.95 }
  finish { reflection 0.85 diffuse 0.1 ambient 0.02 phong 0.6 phong_size 50 }
}
sphere {
  <1.1, 0.8, -1.0>, 0.8
  pigment { rgbt <0.97, 1, 0.98, 0.95> }
  finish { reflection { 0.02, 1.0 fresnel on } conserve_energy diffuse 0 ambient 0 phong 0.7 phong_size 83 }
  interior { ior 1.5 }
}
box {
  <-0.6, 0, -0.6>, <0.6, 1.2, 0.6>
  rotate y*30 translate <0.9, 0, 1.7>
  pigment { rgb <0.8, 0.25, 0.15> }
  finish { diffuse 0.8 ambient 0.08 }
}
