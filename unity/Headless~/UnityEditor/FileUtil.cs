namespace UnityEditor
{
    public class FileUtil
    {
        /// Of a path below `Packages` where the package manager keeps it; others stay as they are.
        public static string GetPhysicalPath(string path) => Headless.Project.PhysicalPath(path);
    }
}
