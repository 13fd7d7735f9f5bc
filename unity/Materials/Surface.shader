// One colour, lit from above whatever lights the scene has, drawn in instances. Its pass names no light mode, so that the built-in
// pipeline and the universal one both draw it.
Shader "Collektive/Surface"
{
    Properties
    {
        _Color ("Colour", Color) = (1, 1, 1, 1)
    }
    SubShader
    {
        Tags { "RenderType" = "Opaque" "Queue" = "Geometry" }
        Pass
        {
            CGPROGRAM
            #pragma vertex vert
            #pragma fragment frag
            #pragma multi_compile_instancing
            #include "UnityCG.cginc"

            struct Corner
            {
                float4 position : POSITION;
                float3 normal : NORMAL;
                UNITY_VERTEX_INPUT_INSTANCE_ID
            };

            struct Point
            {
                float4 position : SV_POSITION;
                float3 normal : TEXCOORD0;
                UNITY_VERTEX_INPUT_INSTANCE_ID
            };

            UNITY_INSTANCING_BUFFER_START(Instance)
                UNITY_DEFINE_INSTANCED_PROP(float4, _Color)
            UNITY_INSTANCING_BUFFER_END(Instance)

            Point vert(Corner corner)
            {
                Point result;
                UNITY_SETUP_INSTANCE_ID(corner);
                UNITY_TRANSFER_INSTANCE_ID(corner, result);
                result.position = UnityObjectToClipPos(corner.position);
                result.normal = UnityObjectToWorldNormal(corner.normal);
                return result;
            }

            float4 frag(Point surface) : SV_Target
            {
                UNITY_SETUP_INSTANCE_ID(surface);
                float light = 0.7 + 0.3 * dot(normalize(surface.normal), normalize(float3(0.3, 1, -0.4)));
                float4 colour = UNITY_ACCESS_INSTANCED_PROP(Instance, _Color);
                return float4(colour.rgb * light, colour.a);
            }
            ENDCG
        }
        // Depth texture of the universal pipeline.
        Pass
        {
            Tags { "LightMode" = "DepthOnly" }
            ColorMask R

            CGPROGRAM
            #pragma vertex vert
            #pragma fragment frag
            #pragma multi_compile_instancing
            #include "UnityCG.cginc"

            float4 vert(appdata_base v) : SV_POSITION
            {
                UNITY_SETUP_INSTANCE_ID(v);
                return UnityObjectToClipPos(v.vertex);
            }

            float4 frag() : SV_Target
            {
                return 0;
            }
            ENDCG
        }
        // Shadows, and the depth texture of the built-in pipeline.
        Pass
        {
            Tags { "LightMode" = "ShadowCaster" }

            CGPROGRAM
            #pragma vertex vert
            #pragma fragment frag
            #pragma multi_compile_shadowcaster
            #pragma multi_compile_instancing
            #include "UnityCG.cginc"

            struct Point
            {
                V2F_SHADOW_CASTER;
            };

            // The macro reads a parameter of this name.
            Point vert(appdata_base v)
            {
                Point result;
                UNITY_SETUP_INSTANCE_ID(v);
                TRANSFER_SHADOW_CASTER_NORMALOFFSET(result)
                return result;
            }

            float4 frag(Point surface) : SV_Target
            {
                SHADOW_CASTER_FRAGMENT(surface)
            }
            ENDCG
        }
    }
}
