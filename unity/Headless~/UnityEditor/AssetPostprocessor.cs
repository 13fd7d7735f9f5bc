namespace UnityEditor
{
    public class AssetPostprocessor { }
}
