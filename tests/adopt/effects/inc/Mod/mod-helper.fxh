// the helper's declarations
#define GENERATE_NORMALS
int gLighting                      < string renderState="LIGHTING"; >;                        //  = 137,
float4 gGlobalAmbient              < string renderState="AMBIENT"; >;
int gDiffuseMaterialSource         < string renderState="DIFFUSEMATERIALSOURCE"; > = 1;
float4 gMaterialAmbient     < string materialState="Ambient"; >;
float4 gMaterialDiffuse     < string materialState="Diffuse"; >;
texture gTexture0           < string textureState="0,Texture"; >;
float4x4 gWorld : WORLD;
float4x4 gWorldViewProjection : WORLDVIEWPROJECTION;
float3 gCameraPosition : CAMERAPOSITION;
float gTime : TIME;
#ifdef GENERATE_NORMALS
    int CUSTOMFLAGS
    <
        string createNormals = "yes";
    >;
#endif
float MTUnlerp( float from, float to, float pos )
{
    if ( from == to )
        return 1.0;
    else
        return ( pos - from ) / ( to - from );
}
float4 MTCalcScreenPosition( float3 InPosition ) { return mul(float4(InPosition,1), gWorldViewProjection); }
float3 MTCalcWorldPosition( float3 InPosition ) { return mul(float4(InPosition,1), gWorld).xyz; }
void MTFixUpNormal( in out float3 OutNormal )
{
    if ( OutNormal.x == 0 && OutNormal.y == 0 && OutNormal.z == 0 )
        OutNormal = float3(0,0,1);
}
float4 MTCalcBuildingDiffuse( float4 InDiffuse )
{
    float4 OutDiffuse;
    if ( !gLighting )
        OutDiffuse = InDiffuse;
    else
    {
        float4 ambient  = gDiffuseMaterialSource == 0 ? gMaterialAmbient : InDiffuse;
        OutDiffuse = gGlobalAmbient * saturate( ambient + 0 );
        OutDiffuse.a *= gMaterialDiffuse.a;
    }
    return OutDiffuse;
}
