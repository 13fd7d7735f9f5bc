// Draws links from buffers, without a mesh: one instance for each pair of nodes, with a bar from each of the two half of the way to the other. Its
// pass names no light mode, so that the built-in pipeline and the universal one both draw it.
Shader "Collektive/Link"
{
    Properties
    {
        _LinkWidth ("Width in metres", Float) = 0.04
    }
    SubShader
    {
        Tags { "RenderType" = "Opaque" "Queue" = "Geometry" }
        Cull Off

        CGINCLUDE
        #pragma target 4.5
        #include "UnityCG.cginc"

        // By node: where it is.
        StructuredBuffer<float4> _LinkPlaces;
        // By pair: places of the two nodes in the lower 24 bits; above them the colour's step of the link that begins there, 255 for none.
        StructuredBuffer<uint2> _LinkPairs;
        float4 _LinkLow;
        float4 _LinkHigh;
        float _LinkWidth;

        static const uint CornersOfBar = 24;
        static const uint LastStep = 15;
        static const uint NoLink = 255;
        // Of the two triangles of a side: how far a corner is along the bar, and across it.
        static const float2 Corners[6] =
        {
            float2(0, -0.5), float2(0, 0.5), float2(1, -0.5), float2(0, 0.5), float2(1, 0.5), float2(1, -0.5)
        };

        struct Point
        {
            float4 position : SV_POSITION;
            float3 normal : TEXCOORD0;
            float4 colour : TEXCOORD1;
        };

        Point vert(uint corner : SV_VertexID, uint instance : SV_InstanceID)
        {
            Point result;
            uint2 pair = _LinkPairs[instance];
            bool isBack = corner >= CornersOfBar;
            uint ownEnd = isBack ? pair.y : pair.x;
            uint otherEnd = isBack ? pair.x : pair.y;
            uint shade = ownEnd >> 24;
            float3 from = _LinkPlaces[ownEnd & 0xFFFFFF].xyz;
            float3 way = 0.5 * (_LinkPlaces[otherEnd & 0xFFFFFF].xyz - from);
            float reach = length(way);
            result.position = float4(0, 0, 0, 0);
            result.normal = float3(0, 1, 0);
            result.colour = lerp(_LinkLow, _LinkHigh, shade / (float)LastStep);
            #ifndef UNITY_COLORSPACE_GAMMA
            result.colour.rgb = GammaToLinearSpace(result.colour.rgb);
            #endif
            // All corners at one point: nothing is drawn.
            if (shade == NoLink || reach == 0) return result;
            float3 across = normalize(cross(abs(way.y) < 0.9 * reach ? float3(0, 1, 0) : float3(1, 0, 0), way));
            float3 upwards = cross(way, across) / reach;
            uint side = (corner % CornersOfBar) / 6;
            float3 outwards = side % 2 == 0 ? upwards : across;
            float3 along = side % 2 == 0 ? across : -upwards;
            if (side >= 2)
            {
                outwards = -outwards;
                along = -along;
            }
            float2 place = Corners[corner % 6];
            float3 world = from + place.x * way + _LinkWidth * (place.y * along + 0.5 * outwards);
            result.position = mul(UNITY_MATRIX_VP, float4(world, 1));
            result.normal = outwards;
            return result;
        }
        ENDCG

        Pass
        {
            CGPROGRAM
            #pragma vertex vert
            #pragma fragment frag

            float4 frag(Point surface) : SV_Target
            {
                float light = 0.7 + 0.3 * dot(normalize(surface.normal), normalize(float3(0.3, 1, -0.4)));
                return float4(surface.colour.rgb * light, surface.colour.a);
            }
            ENDCG
        }
        // Depth textures of the universal and the built-in pipeline. Links cast no shadows.
        Pass
        {
            Tags { "LightMode" = "DepthOnly" }
            ColorMask R

            CGPROGRAM
            #pragma vertex vert
            #pragma fragment frag

            float4 frag() : SV_Target
            {
                return 0;
            }
            ENDCG
        }
        Pass
        {
            Tags { "LightMode" = "ShadowCaster" }

            CGPROGRAM
            #pragma vertex vert
            #pragma fragment frag

            float4 frag() : SV_Target
            {
                return 0;
            }
            ENDCG
        }
    }
}
