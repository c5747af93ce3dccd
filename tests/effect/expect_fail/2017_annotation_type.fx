// expect: 2017_annotation_type.fx(2,45): error TG2017: annotation Width takes one number
Texture2D gMap : RENDERCOLORTARGET < string Width = "64"; >;
