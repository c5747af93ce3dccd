// expect: 1103_unknown_type.fx(2,1): error TG1103: unknown type 'flaot4'; did you mean 'float4'?
flaot4 gTint < string UIName = "Tint"; >;
